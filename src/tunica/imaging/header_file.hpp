// Image files that begin with a header in text: what NRRD and MetaImage have in common.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace tunica::imaging {

/// Lines of a header, from the beginning of a file on.
class HeaderLines {
 public:
  /// InputError when the file cannot be read.
  explicit HeaderLines(const std::filesystem::path& path);
  /// Goes on to the next line; false at the end of the file. InputError when the header is longer than any is.
  bool next();
  const std::string& text() const { return text_; }                       ///< without blanks around it
  std::int64_t number() const { return number_; }                         ///< 1 for the first one
  std::int64_t offset() const { return static_cast<std::int64_t>(at_); }  ///< in the file, of what follows the line

 private:
  std::filesystem::path path_;
  std::string start_;  ///< of the file
  bool whole_ = true;  ///< `start_` is all of it
  std::size_t at_ = 0;
  std::int64_t number_ = 0;
  std::string text_;
};

/// Fields by their name in lower case without blanks, and where the data begin.
struct TextHeader {
  struct Field {
    std::string value;
    std::int64_t line;
  };
  std::filesystem::path path;
  std::map<std::string, Field> fields{};
  std::int64_t data_offset = 0;  ///< in the file of the header

  /// InputError when the header has that field, or the field has no value.
  void add(const std::string& name, const std::string& value, std::int64_t line);
  const std::string* find(const std::string& name) const;
  /// The first of several names that the header has, or none.
  std::string first_of(std::initializer_list<const char*> names) const;
  /// InputError when the field is missing.
  const std::string& need(const std::string& name) const;
  /// `count` numbers of a field; brackets and commas stand for blanks. InputError when they are others or too many.
  std::vector<double> numbers(const std::string& name, std::size_t count) const;
  std::vector<std::int64_t> whole_numbers(const std::string& name, std::size_t count) const;
  /// As numbers, and each above zero.
  std::vector<double> spacings(const std::string& name) const;
  /// Throws InputError about a field: file and line, its value, and `what` is wrong with it.
  [[noreturn]] void refuse(const std::string& name, const std::string& what, const std::string& remedy) const;
};

/// "a  b" -> {"a", "b"}.
std::vector<std::string> words(const std::string& text);
std::string trimmed(const std::string& text);
std::string lower(std::string text);
/// Text of a file for a message: shortened, and without what a terminal would not show.
std::string printable(const std::string& text);

}  // namespace tunica::imaging
