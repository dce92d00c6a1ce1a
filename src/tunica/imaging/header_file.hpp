// Image files that begin with a header in text: what NRRD and MetaImage have in common.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tunica::imaging {

/// Fields by their name in lower case without blanks, and where the data begin.
struct TextHeader {
  std::filesystem::path path;
  std::map<std::string, std::string> fields;
  std::string rest;  ///< of the file, after the header

  const std::string* find(const std::string& name) const;
  /// InputError when the field is missing.
  const std::string& need(const std::string& name) const;
  /// `count` numbers of a field; brackets and commas stand for blanks. InputError when they are others.
  std::vector<double> numbers(const std::string& name, std::size_t count) const;
};

/// The whole file; InputError when it cannot be read.
std::string read_bytes(const std::filesystem::path& path);
/// Of zlib or gzip streams; InputError when they are damaged.
std::string decompressed(const std::string& bytes, const std::filesystem::path& path);
std::string compressed(const std::string& bytes, bool gzip);
/// "a  b" -> {"a", "b"}.
std::vector<std::string> words(const std::string& text);
std::string trimmed(const std::string& text);
std::string lower(std::string text);

}  // namespace tunica::imaging
