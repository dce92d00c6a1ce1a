#include "tunica/base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "tunica/base/error.hpp"

namespace tunica::text {

namespace {

constexpr std::string_view mark = "\xEF\xBB\xBF", no_break_space = "\xC2\xA0";
constexpr const char* save_as_utf8 =
    "save it as UTF-8 (Excel: \"CSV UTF-8\"; editors: encoding UTF-8), or `iconv -f {} -t utf-8`";

unsigned byte(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Bytes of the character that begins at `i`; 0: none begins there.
std::size_t length_at(std::string_view text, std::size_t i) {
  const unsigned first = byte(text, i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : (first & 0xF0) == 0xE0         ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(text, i + k) & 0xC0) != 0x80) return 0;
  const unsigned second = byte(text, i + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool outside = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || outside ? 0 : length;
}

/// Every second byte of Latin text in UTF-16 is zero, and three of four in UTF-32.
const char* wide_encoding(std::string_view bytes) {
  const auto begins = [&](std::string_view start) { return bytes.starts_with(start); };
  if (begins(std::string_view("\xFF\xFE\0\0", 4)) || begins(std::string_view("\0\0\xFE\xFF", 4))) return "UTF-32";
  if (begins("\xFF\xFE") || begins("\xFE\xFF")) return "UTF-16";
  const auto start = bytes.substr(0, 4096);
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < start.size(); ++i)
    if (start[i] == '\0') ++zeros[i % 2];
  const std::size_t most = std::max(zeros[0], zeros[1]), least = std::min(zeros[0], zeros[1]);
  if (start.size() < 4 || 4 * most < start.size()) return nullptr;
  return 4 * least >= start.size() - 4 ? "UTF-32" : 10 * least <= most ? "UTF-16" : nullptr;
}

const char* other_kind(std::string_view bytes) {
  const std::pair<std::string_view, const char*> kinds[] = {
      {"PK\x03\x04", "a ZIP archive, such as an Excel or LibreOffice workbook"},
      {"\xD0\xCF\x11\xE0", "an old Excel or Word document"},
      {"\x1F\x8B", "compressed by gzip"},
      {"%PDF", "a PDF document"},
      {"\x89PNG", "a PNG picture"}};
  for (const auto& [start, kind] : kinds)
    if (bytes.starts_with(start)) return kind;
  return nullptr;
}

/// "line 3, column 7" of the byte at `at`. Columns count characters.
std::string place_of(std::string_view text, std::size_t at) {
  std::size_t line = 1, begin = 0;
  for (std::size_t i = 0; i < at; ++i)
    if (text[i] == '\n' || (text[i] == '\r' && !(i + 1 < text.size() && text[i + 1] == '\n'))) {
      ++line;
      begin = i + 1;
    }
  const auto characters =
      std::count_if(text.begin() + static_cast<std::ptrdiff_t>(begin), text.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  return fmt::format("line {}, column {}", line, characters + 1);
}

bool is_control(char c) {
  const auto b = static_cast<unsigned char>(c);
  return (b < 0x20 && c != '\t' && c != '\n' && c != '\r') || b == 0x7F;
}

/// The letter that the byte is in Latin-1 and, above 0x9F, in Windows-1252.
std::string as_latin(unsigned b) {
  if (b < 0xA0) return "";
  const char letter[] = {static_cast<char>(0xC0 | (b >> 6)), static_cast<char>(0x80 | (b & 0x3F)), 0};
  return fmt::format("; in Latin-1 and Windows-1252 it is '{}'", letter);
}

}  // namespace

std::size_t valid_utf8(std::string_view bytes) {
  std::size_t i = 0;
  while (i < bytes.size()) {
    const std::size_t length = length_at(bytes, i);
    if (length == 0) return i;
    i += length;
  }
  return i;
}

std::string checked(std::string bytes, const std::string& file) {
  const std::string name = printable(file, 400);
  if (const char* encoding = wide_encoding(bytes))
    throw InputError(name, fmt::format("is {}, not UTF-8", encoding),
                     fmt::format(fmt::runtime(save_as_utf8), encoding));
  if (const char* kind = other_kind(bytes))
    throw InputError(name, fmt::format("is no text but {}", kind), "export the text itself, as UTF-8");
  if (std::string_view(bytes).starts_with(mark)) bytes.erase(0, mark.size());
  if (const std::size_t at = valid_utf8(bytes); at < bytes.size())
    throw InputError(
        name + ", " + place_of(bytes, at),
        fmt::format("holds the byte 0x{:02x}, which is no UTF-8 there{}", byte(bytes, at), as_latin(byte(bytes, at))),
        fmt::format(fmt::runtime(save_as_utf8), "windows-1252"));
  if (const auto found = std::find_if(bytes.begin(), bytes.end(), is_control); found != bytes.end())
    throw InputError(name + ", " + place_of(bytes, static_cast<std::size_t>(found - bytes.begin())),
                     fmt::format("holds the control character 0x{:02x}", static_cast<unsigned char>(*found)),
                     "remove it; the file must be plain text");
  return bytes;
}

std::string read(const std::filesystem::path& file) {
  const std::string name = printable(file.string(), 400);
  const char* remedy = "check its name and permissions";
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw InputError(name, "is a folder, a file is due", remedy);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(name, fmt::format("cannot be read: {}", std::strerror(errno)), remedy);
  std::string bytes;
  for (char part[65536]; stream.read(part, sizeof part), stream.gcount() > 0;) {
    bytes.append(part, static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > largest_text)
      throw InputError(name, fmt::format("is larger than {} MB", largest_text >> 20), "name a text file");
  }
  if (stream.bad()) throw InputError(name, "cannot be read", remedy);
  return checked(std::move(bytes), file.string());
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (result.size() >= longest) return result + "...";
    const std::size_t length = length_at(text, i);
    if (length == 0 || is_control(text[i]) || text[i] == '\n' || text[i] == '\r' || text[i] == '\t')
      result += fmt::format("\\x{:02x}", byte(text, i));
    else if (length == 2 && byte(text, i) == 0xC2 && byte(text, i + 1) < 0xA0)  // C1, which terminals obey as well
      result += fmt::format("\\x{:02x}\\x{:02x}", byte(text, i), byte(text, i + 1));
    else
      result += text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](std::string_view rest, bool at_end) -> std::size_t {
    if (rest.empty()) return 0;
    const char c = at_end ? rest.back() : rest.front();
    if (c == ' ' || c == '\t' || c == '\r') return 1;
    for (const auto wide : {mark, no_break_space})
      if (at_end ? rest.ends_with(wide) : rest.starts_with(wide)) return wide.size();
    return 0;
  };
  while (const auto n = blank(text, false)) text.remove_prefix(n);
  while (const auto n = blank(text, true)) text.remove_suffix(n);
  return text;
}

std::string decimal_exponent(std::string_view number) {
  std::string result(number);
  if (const auto d = number.find_first_of("dD");
      d != std::string_view::npos && number.find_first_not_of("0123456789+-.dD") == std::string_view::npos)
    result[d] = 'e';
  return result;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace tunica::text
