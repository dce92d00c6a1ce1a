#include "tunica/mesh_io/vtk_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/mesh_io/vtk_array_check.hpp"
#include "tunica/mesh_io/xml_tags.hpp"

namespace tunica::mesh_io {

namespace {

constexpr std::size_t deepest = 20;

/// An array as the head of its tag describes it.
struct ArrayTag {
  XmlTag tag;
  std::string section;       ///< Points, Cells, PointData, ...
  std::string_view content;  ///< between its tags
};

struct Piece {
  std::size_t place = 0;
  std::map<std::string, std::int64_t> counts;  ///< NumberOfPoints, NumberOfCells, NumberOfPolys, ...
  std::vector<ArrayTag> arrays;
};

class Check {
 public:
  Check(std::string_view text, const std::string& where, const std::string& kind,
        const std::optional<std::vector<std::string>>& wanted)
      : text_(text), where_(where), kind_(kind), wanted_(wanted), tags_(text, where_) {}

  /// Returns the places of the names of tags that VTK is not to find.
  std::vector<std::size_t> run() {
    read_head();
    read_tags();
    for (const auto& array : loose_) check_field_array(array);
    if (pieces_.empty()) tags_.refuse(0, "there is no <Piece>");
    for (const auto& piece : pieces_) check_piece(piece);
    return hidden_;
  }

 private:
  // --- structure ----------------------------------------------------------------------------------------------------

  void read_head() {
    if (text_.find_first_not_of(" \t\r\n") == std::string_view::npos) another_kind("is empty");
    if (text_.starts_with("# vtk")) another_kind("is a legacy VTK file, not an XML one");
    if (text_.starts_with("version https://git-lfs"))
      throw InputError(where_, "is a pointer of Git LFS, not the file that it stands for",
                       "fetch the files of the repository with `git lfs pull`");
    if (text_[text_.find_first_not_of(" \t\r\n\xef\xbb\xbf")] != '<') another_kind("is no XML file");
    const auto head = tags_.next();
    if (!head || head->name != "VTKFile" || head->empty) another_kind("is an XML file, but not one of VTK");
    if (head->attribute("type") != kind_)
      another_kind(fmt::format("holds VTK data of type `{}`", head->attribute("type")));
    const auto order = head->attribute("byte_order"), header = head->attribute("header_type");
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
      tags_.refuse(head->begin, fmt::format("byte_order `{}` is not known", order));
    if (!header.empty() && header != "UInt32" && header != "UInt64")
      tags_.refuse(head->begin, fmt::format("header_type `{}` is not known", header));
    encoding_.big_endian = order == "BigEndian";
    encoding_.header_bytes = header == "UInt64" ? 8 : 4;
    encoding_.compressor = head->attribute("compressor");
    if (!known_compressor(encoding_.compressor))
      tags_.refuse(head->begin, fmt::format("compressor `{}` is not known", encoding_.compressor));
  }
  [[noreturn]] void another_kind(const std::string& what) const {
    throw InputError(where_, fmt::format("{}; a VTK XML file of type {} is needed", what, kind_),
                     fmt::format("save it from ParaView or SimVascular as {}", kind_ == "PolyData" ? ".vtp" : ".vtu"));
  }

  void read_tags() {
    std::vector<std::string> open = {"VTKFile"};
    while (const auto tag = tags_.next()) {
      if (tag->closing) {
        if (open.empty() || open.back() != tag->name)
          tags_.refuse(tag->begin, fmt::format("</{}> closes nothing", tag->name));
        open.pop_back();
        if (tag->name == "FieldData" && has_texts_) {
          hidden_.push_back(field_data_ + 1);
          hidden_.push_back(tag->begin + 2);
          has_texts_ = false;
        }
        continue;
      }
      if (open.empty()) tags_.refuse(tag->begin, fmt::format("<{}> stands behind the end", tag->name));
      if (tag->name == "AppendedData") return read_appended(*tag);
      take(*tag, open);
      if (!tag->empty) open.emplace_back(tag->name);
      if (open.size() > deepest) tags_.refuse(tag->begin, "tags are nested too deeply");
    }
    if (!open.empty()) tags_.refuse(text_.size(), fmt::format("the file ends before </{}>", open.back()));
  }

  void take(const XmlTag& tag, const std::vector<std::string>& open) {
    if (!tag.attribute("TimeValues").empty()) tags_.refuse(tag.begin, "it holds several time steps, one is needed");
    if (tag.name == "FieldData") {
      if (open.back() == tag.name) tags_.refuse(tag.begin, "<FieldData> stands within <FieldData>");
      field_data_ = tag.begin;
    }
    if (tag.name == "Piece") {
      if (open.size() != 2) tags_.refuse(tag.begin, fmt::format("<Piece> stands within <{}>", open.back()));
      pieces_.push_back({tag.begin, counts_of(tag), {}});
    }
    if (tag.name != "DataArray" && tag.name != "Array") return;
    ArrayTag array{tag, open.back(), {}};
    if (!tag.empty) array.content = text_.substr(tag.end, std::min(text_.find('<', tag.end), text_.size()) - tag.end);
    const bool in_piece = open.size() == 4 && open[2] == "Piece";
    has_texts_ |= !in_piece && !bytes_of_type(tag.attribute("type"));
    (in_piece ? pieces_.back().arrays : loose_).push_back(std::move(array));
  }

  std::map<std::string, std::int64_t> counts_of(const XmlTag& tag) const {
    std::map<std::string, std::int64_t> counts;
    for (const auto& [key, value] : tag.attributes)
      if (key.starts_with("NumberOf")) counts[std::string(key)] = whole_number(tag, key);
    return counts;
  }

  /// Throws when it is none, or out of all proportion to the file.
  std::int64_t whole_number(const XmlTag& tag, std::string_view key) const {
    const auto value = tag.attribute(key);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const auto most = static_cast<std::int64_t>(text_.size()) * largest_expansion;
    if (error != std::errc() || end != value.data() + value.size() || number < 0 || number > most)
      tags_.refuse(tag.begin, fmt::format("{}=\"{}\" is not possible in a file of {} bytes", key, value.substr(0, 40),
                                          text_.size()));
    return number;
  }

  void read_appended(const XmlTag& tag) {
    const auto mark = text_.find_first_not_of(" \t\r\n", tag.end);
    if (tag.empty || mark == std::string_view::npos || text_[mark] != '_')
      tags_.refuse(tag.begin, "the appended data do not begin with `_`");
    appended_ = text_.substr(mark + 1);
    appended_base64_ = tag.attribute("encoding") != "raw";
    if (appended_base64_) appended_ = appended_->substr(0, appended_->find('<'));
  }

  // --- arrays -------------------------------------------------------------------------------------------------------

  static std::int64_t count(const Piece& piece, const char* name) {
    const auto found = piece.counts.find(name);
    return found == piece.counts.end() ? 0 : found->second;
  }

  void check_piece(const Piece& piece) const {
    if (!piece.counts.contains("NumberOfPoints")) tags_.refuse(piece.place, "<Piece> has no NumberOfPoints");
    const auto points = count(piece, "NumberOfPoints");
    std::int64_t cells = count(piece, "NumberOfCells");
    if (points > 0) check(*geometry_array(piece, "Points", ""), 3 * points);
    if (kind_ == "UnstructuredGrid") {
      check_cells(piece, "Cells", cells);
      if (cells > 0) check(*geometry_array(piece, "Cells", "types"), cells);
    } else {
      cells = 0;
      for (const char* part : {"Verts", "Lines", "Strips", "Polys"}) {
        const auto n = count(piece, fmt::format("NumberOf{}", part).c_str());
        check_cells(piece, part, n);
        cells += n;
      }
    }
    check_names(piece);
    for (const auto& array : piece.arrays) {
      const std::string name(array.tag.attribute("Name"));
      if (wanted_ && std::find(wanted_->begin(), wanted_->end(), name) == wanted_->end()) continue;
      if (array.section == "PointData") check(array, points * components(array));
      if (array.section == "CellData") check(array, cells * components(array));
    }
  }

  /// VTK replaces an array by the next one of its name, and then looks for as many as the file has.
  void check_names(const Piece& piece) const {
    std::set<std::pair<std::string, std::string_view>> seen;
    for (const auto& array : piece.arrays) {
      const auto name = array.tag.attribute("Name");
      if (!name.empty() && !seen.emplace(array.section, name).second)
        tags_.refuse(array.tag.begin, fmt::format("<{}> has its array {} twice", array.section, name));
    }
  }

  void check_cells(const Piece& piece, const std::string& section, std::int64_t cells) const {
    for (const auto& array : piece.arrays)
      if (array.section == section && array.tag.attribute("Name").starts_with("face"))
        tags_.refuse(array.tag.begin, "it holds polyhedra, only tetrahedra and triangles are read");
    if (cells == 0) return;
    const auto* offsets = geometry_array(piece, section, "offsets");
    // Others could hold values that VTK turns into negative sizes.
    const auto type = offsets->tag.attribute("type");
    if (!type.starts_with("Int") && type != "UInt8" && type != "UInt16" && type != "UInt32")
      tags_.refuse(offsets->tag.begin, fmt::format("offsets are of type `{}`, Int64 or Int32 are needed", type));
    check(*offsets, cells);
    const auto corners = value_at(described(*offsets), cells - 1, encoding_);
    if (!corners || *corners < 0)
      tags_.refuse(offsets->tag.begin, "the last of the offsets cannot be read, or is negative");
    if (*corners > static_cast<std::int64_t>(text_.size()) * largest_expansion)
      tags_.refuse(offsets->tag.begin,
                   fmt::format("an offset of {} is not possible in a file of {} bytes", *corners, text_.size()));
    check(*geometry_array(piece, section, "connectivity"), *corners);
  }

  /// The one array of that name in the section; an empty name means any.
  const ArrayTag* geometry_array(const Piece& piece, const std::string& section, const std::string& name) const {
    const ArrayTag* found = nullptr;
    for (const auto& array : piece.arrays) {
      if (array.section != section || (!name.empty() && array.tag.attribute("Name") != name)) continue;
      if (found) tags_.refuse(array.tag.begin, fmt::format("<{}> has its array {} twice", section, name));
      found = &array;
    }
    if (!found) tags_.refuse(piece.place, fmt::format("<{}> has no array {}", section, name));
    if (const auto due = section == "Points" ? 3 : 1; components(*found) != due)
      tags_.refuse(found->tag.begin, fmt::format("it has {} components, {} are needed", components(*found), due));
    return found;
  }

  std::int64_t components(const ArrayTag& array) const {
    constexpr std::int64_t most = 1000;
    if (array.tag.attribute("NumberOfComponents").empty()) return 1;
    const auto n = whole_number(array.tag, "NumberOfComponents");
    if (n < 1 || n > most) tags_.refuse(array.tag.begin, fmt::format("NumberOfComponents=\"{}\" is out of range", n));
    return n;
  }

  /// Arrays of the file as a whole, which VTK reads whether they are wanted or not.
  void check_field_array(const ArrayTag& array) const {
    if (!bytes_of_type(array.tag.attribute("type"))) return;  // hidden
    const bool counted = !array.tag.attribute("NumberOfTuples").empty();
    check(array, counted ? whole_number(array.tag, "NumberOfTuples") * components(array) : 0);
  }

  VtkArray described(const ArrayTag& array) const {
    VtkArray result;
    const auto type = array.tag.attribute("type"), format = array.tag.attribute("format");
    const auto bytes = bytes_of_type(type);
    if (!bytes) tags_.refuse(array.tag.begin, fmt::format("an array of type `{}`, numbers are needed", type));
    result.value_bytes = *bytes;
    result.is_signed = type.starts_with("Int");
    if (format == "appended") {
      const auto offset = whole_number(array.tag, "offset");
      if (!appended_ || offset > std::ssize(*appended_))
        tags_.refuse(array.tag.begin, fmt::format("its data begin at byte {} of the appended data, which are {} bytes",
                                                  offset, appended_ ? appended_->size() : 0));
      result.data = appended_->substr(static_cast<std::size_t>(offset));
      result.form = appended_base64_ ? VtkArray::Form::base64 : VtkArray::Form::raw;
    } else {
      result.data = array.content;
      result.form = format == "ascii" ? VtkArray::Form::ascii : VtkArray::Form::base64;
    }
    return result;
  }

  void check(const ArrayTag& array, std::int64_t values) const {
    const auto problem = array_problem(described(array), values, encoding_);
    if (!problem.empty())
      tags_.refuse(array.tag.begin,
                   fmt::format("array {} of <{}>: {}", array.tag.attribute("Name"), array.section, problem));
  }

  std::string_view text_;
  std::string where_, kind_;
  const std::optional<std::vector<std::string>>& wanted_;
  XmlTags tags_;
  VtkEncoding encoding_;
  std::vector<Piece> pieces_;
  std::vector<ArrayTag> loose_;
  std::vector<std::size_t> hidden_;
  std::size_t field_data_ = 0;  ///< where the last one begins
  bool has_texts_ = false;      ///< among its arrays
  std::optional<std::string_view> appended_;
  bool appended_base64_ = false;
};

}  // namespace

std::string check_vtk_file(const std::filesystem::path& path, const std::string& kind,
                           const std::optional<std::vector<std::string>>& wanted) {
  std::error_code error;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !stream)
    throw InputError(path.string(), "there is no such file, or it cannot be read", "check its name and permissions");
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto hidden = Check(text, path.string(), kind, wanted).run();
  if (hidden.empty()) return {};
  // Another name of the same length, for which VTK has no use.
  for (const auto place : hidden) text[place] = 'x';
  return text;
}

}  // namespace tunica::mesh_io
