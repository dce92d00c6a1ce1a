// The tags of an XML file, one after the other, without a tree: enough to look through a file before a library reads
// it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tunica::mesh_io {

/// What XML counts as space.
inline constexpr std::string_view xml_space = " \t\r\n";

struct XmlTag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;  ///< as written, entities unresolved
  bool closing = false;                                                   ///< </name>
  bool empty = false;                                                     ///< <name/>
  std::size_t begin = 0, end = 0;                                         ///< from `<` to behind `>`

  /// Empty when it is absent.
  std::string_view attribute(std::string_view wanted) const;
};

class XmlTags {
 public:
  /// `where` names the file in messages; both must outlive this object.
  XmlTags(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  /// The next tag, nothing at the end of the text. Comments and processing instructions are skipped. Throws InputError
  /// for a tag that does not end, for attributes without quotes, and for declarations (<!DOCTYPE).
  std::optional<XmlTag> next();
  std::size_t line_of(std::size_t place) const;
  [[noreturn]] void refuse(std::size_t place, const std::string& what) const;

 private:
  std::size_t behind(std::string_view mark, std::size_t from) const;
  void read_attribute(XmlTag& tag);
  void skip_space();

  std::string_view text_;
  const std::string& where_;
  std::size_t at_ = 0;
};

}  // namespace tunica::mesh_io
