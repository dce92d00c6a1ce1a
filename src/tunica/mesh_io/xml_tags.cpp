#include "tunica/mesh_io/xml_tags.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::mesh_io {

std::string_view XmlTag::attribute(std::string_view wanted) const {
  for (const auto& [key, value] : attributes)
    if (key == wanted) return value;
  return {};
}

std::size_t XmlTags::line_of(std::size_t place) const {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(place, text_.size()));
  return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

void XmlTags::refuse(std::size_t place, const std::string& what) const {
  throw InputError(fmt::format("{}:{}", where_, line_of(place)), "cannot be read: " + what,
                   "give a complete VTK XML file: export or copy it again");
}

std::size_t XmlTags::behind(std::string_view mark, std::size_t from) const {
  const auto found = text_.find(mark, from);
  if (found == std::string_view::npos) refuse(from, fmt::format("the file ends before a `{}`", mark));
  return found + mark.size();
}

void XmlTags::skip_space() { at_ = std::min(text_.find_first_not_of(xml_space, at_), text_.size()); }

void XmlTags::read_attribute(XmlTag& tag) {
  const auto begin = at_;
  const auto equals = text_.find_first_of("=<>", at_);
  if (equals == std::string_view::npos || text_[equals] != '=') refuse(begin, "an attribute has no value");
  auto key = text_.substr(at_, equals - at_);
  key = key.substr(0, key.find_last_not_of(xml_space) + 1);
  at_ = equals + 1;
  skip_space();
  if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\''))
    refuse(begin, "the value of an attribute is not in quotes");
  const auto value = at_ + 1;
  at_ = behind(text_.substr(at_, 1), value);
  tag.attributes.emplace_back(key, text_.substr(value, at_ - 1 - value));
}

std::optional<XmlTag> XmlTags::next() {
  for (;;) {
    at_ = text_.find('<', at_);
    if (at_ == std::string_view::npos) return std::nullopt;
    const auto rest = text_.substr(at_);
    if (rest.starts_with("<!--"))
      at_ = behind("-->", at_);
    else if (rest.starts_with("<?"))
      at_ = behind("?>", at_);
    else if (rest.starts_with("<!"))
      refuse(at_, "holds a declaration (<!...), which VTK files have none of");
    else
      break;
  }
  XmlTag tag;
  tag.begin = at_++;
  tag.closing = at_ < text_.size() && text_[at_] == '/';
  at_ += tag.closing;
  const auto name_end = std::min(text_.find_first_of(" \t\r\n/>", at_), text_.size());
  tag.name = text_.substr(at_, name_end - at_);
  if (tag.name.empty()) refuse(tag.begin, "a `<` begins no tag");
  at_ = name_end;
  for (skip_space(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/'; skip_space()) read_attribute(tag);
  tag.empty = at_ < text_.size() && text_[at_] == '/';
  at_ += tag.empty;
  if (at_ >= text_.size() || text_[at_] != '>') refuse(tag.begin, fmt::format("the tag <{}> does not end", tag.name));
  tag.end = ++at_;
  return tag;
}

}  // namespace tunica::mesh_io
