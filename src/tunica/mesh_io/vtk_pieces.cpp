// The head of results that several ranks have written. Read without VTK, which would read the pieces unchecked, and
// copies their arrays as if each had the type and the components that the head says.
#include <fmt/format.h>

#include <charconv>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/mesh_io/xml_tags.hpp"

namespace tunica::mesh_io {

namespace {

constexpr int most_components = 1000;

void check_components(const XmlTags& tags, const XmlTag& tag) {
  const auto text = tag.attribute("NumberOfComponents");
  int number = 1;
  if (text.empty()) return;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 1 || number > most_components)
    tags.refuse(tag.begin, fmt::format("NumberOfComponents=\"{}\" is out of range", text::printable(text, 40)));
}

}  // namespace

VtkPieces read_vtk_pieces(const std::filesystem::path& path, const std::string& kind) {
  const std::string text = text::read(path), where = path.string();
  XmlTags tags(text, where);
  const auto head = tags.next();
  if (!head || head->name != "VTKFile" || head->attribute("type") != "P" + kind)
    throw InputError(where, fmt::format("is no VTK XML file of type P{}", kind),
                     "give a complete file: export or copy it again");
  VtkPieces pieces;
  std::string_view section;
  bool complete = false;
  while (const auto tag = tags.next()) {
    complete |= tag->closing && tag->name == head->name;
    if (tag->name == "PPointData" || tag->name == "PCellData")
      section = tag->closing || tag->empty ? std::string_view() : tag->name;
    if (tag->name == "PDataArray" && !tag->closing) {
      check_components(tags, *tag);
      const std::string name(tag->attribute("Name"));
      if (section == "PPointData") pieces.point_arrays.push_back(name);
      if (section == "PCellData") pieces.cell_arrays.push_back(name);
    }
    if (tag->name != "Piece" || tag->closing) continue;
    const auto source = tag->attribute("Source");
    if (source.empty()) tags.refuse(tag->begin, "<Piece> names no file");
    pieces.files.push_back(path.parent_path() / source);
  }
  if (!complete) tags.refuse(text.size(), "the file ends before </VTKFile>");
  return pieces;
}

}  // namespace tunica::mesh_io
