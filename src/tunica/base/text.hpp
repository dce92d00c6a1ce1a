// Text of files that others wrote: UTF-8 or refused, with what it seems to be instead.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace tunica::text {

/// Most that a text file may hold, in bytes: a device or a wrong file must not fill the memory.
inline constexpr std::size_t largest_text = std::size_t{1} << 30;

/// The whole text of a file, without byte-order mark. Throws InputError: what cannot be read, is a folder or too
/// large, and as checked().
std::string read(const std::filesystem::path& file);

/// `bytes` without byte-order mark. Throws InputError that names `file`, the line and the remedy where they are no
/// UTF-8: UTF-16 and UTF-32, archives, letters of Latin-1 or Windows-1252, control characters.
std::string checked(std::string bytes, const std::string& file);

/// Bytes in front of the first one that is not UTF-8 (RFC 3629); the size when all are.
std::size_t valid_utf8(std::string_view bytes);

/// The text for messages: other bytes than UTF-8 and control characters as \xfc, no more than `longest` of it.
std::string printable(std::string_view text, std::size_t longest = 60);

/// Without blanks, tabs, byte-order marks and no-break spaces around.
std::string_view trimmed(std::string_view text);

/// Of digits, signs, a point and one D, as Fortran writes exponents: the same with an e. Any other text as it is.
std::string decimal_exponent(std::string_view number);

/// ASCII letters in lower case.
std::string lower(std::string_view text);

}  // namespace tunica::text
