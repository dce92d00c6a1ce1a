// Lines and numbers of a text file, with their place for messages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::geometry {

class TextLines {
 public:
  /// Both must outlive this object.
  TextLines(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  /// Goes to the next line; false at the end. A backslash at the end of a line joins the next one to it.
  bool next();
  int number() const { return number_; }
  /// Of the line, separated by blanks.
  const std::vector<std::string_view>& words() const { return words_; }
  /// First byte behind the line.
  std::size_t place() const { return at_; }

  /// Word `i` as a number; refuses the line where it is none.
  double real(std::size_t i) const;
  std::int64_t integer(std::size_t i) const { return integer(i < words_.size() ? words_[i] : ""); }
  std::int64_t integer(std::string_view word) const;
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string_view text_;
  const std::string& where_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
  int number_ = 0;
};

/// The number that the whole word is, a sign before it allowed; nothing when it is none.
std::optional<double> number_of(std::string_view word);

/// A short piece of a file for a message, without what a terminal cannot show.
std::string shown(std::string_view word);

}  // namespace tunica::geometry
