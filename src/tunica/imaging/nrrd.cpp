// NRRD as in its definition, teem.sourceforge.net/nrrd/format.html, for one three-dimensional scalar image.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/imaging/header_file.hpp"
#include "tunica/imaging/image_formats.hpp"
#include "tunica/imaging/voxel_data.hpp"

namespace tunica::imaging {

namespace {

TextHeader read_nrrd_header(const std::filesystem::path& path) {
  TextHeader header{.path = path};
  HeaderLines lines(path);
  if (!lines.next() || !lines.text().starts_with("NRRD"))
    throw InputError(path.string(), "is no NRRD file", "check how it was made");
  while (lines.next() && !lines.text().empty()) {
    const auto& line = lines.text();
    if (line[0] == '#') continue;
    // `key:=value` holds what others noted in the file, `field: value` what describes the image.
    const auto colon = line.find(':');
    if (colon == std::string::npos)
      throw InputError(fmt::format("{}:{}", path.string(), lines.number()),
                       fmt::format("'{}' is no line of a NRRD header", printable(line)),
                       "write `field: value`, and a blank line before the data");
    if (line.substr(colon).starts_with(":=")) continue;
    const auto name = lower(trimmed(line.substr(0, colon))), value = trimmed(line.substr(colon + 1));
    if (!value.empty() || name != "content") header.add(name, value, lines.number());
  }
  header.data_offset = lines.offset();
  return header;
}

/// NRRD has several names for a type, such as short, short int, signed short int, int16 and int16_t.
ValueType nrrd_value_type(const TextHeader& header) {
  static const std::map<std::string, ValueType> types = {
      {"char", ValueType::int8},      {"int8", ValueType::int8},     {"uchar", ValueType::uint8},
      {"uint8", ValueType::uint8},    {"short", ValueType::int16},   {"int16", ValueType::int16},
      {"ushort", ValueType::uint16},  {"uint16", ValueType::uint16}, {"", ValueType::int32},
      {"int32", ValueType::int32},    {"u", ValueType::uint32},      {"uint32", ValueType::uint32},
      {"longlong", ValueType::int64}, {"int64", ValueType::int64},   {"ulonglong", ValueType::uint64},
      {"uint64", ValueType::uint64},  {"float", ValueType::float32}, {"double", ValueType::float64}};
  std::string name;
  for (const auto& word : words(lower(header.need("type")))) {
    if (word == "unsigned") name += "u";
    if (word != "unsigned" && word != "signed" && word != "int") name += word == "uint" ? "u" : word;
  }
  if (name.ends_with("_t")) name.resize(name.size() - 2);
  if (const auto found = types.find(name); found != types.end()) return found->second;
  header.refuse("type", "such values cannot be read", "write the labels as whole numbers");
}

/// Which of the file's axes point against the patient axes.
Vec3<double> axis_signs(const TextHeader& header) {
  const auto* space = header.find("space");
  const auto name = space ? lower(*space) : "";
  // A file that names no space, or one without anatomy, is taken as it is.
  if (name.empty() || name == "left-posterior-superior" || name == "lps" || name == "scanner-xyz" ||
      name == "3d-right-handed")
    return {{1, 1, 1}};
  if (name == "right-anterior-superior" || name == "ras") return {{-1, -1, 1}};
  if (name == "left-anterior-superior" || name == "las") return {{1, -1, 1}};
  header.refuse("space", "this space is not known", "write it in left-posterior-superior or right-anterior-superior");
}

/// Metres in one unit of the space, or of its axes where the file has no space. Without any they are mm.
double length_unit(const TextHeader& header) {
  static const std::map<std::string, double> known = {
      {"\"\"", 1e-3}, {"\"mm\"", 1e-3}, {"\"cm\"", 1e-2}, {"\"m\"", 1}, {"\"um\"", 1e-6}};
  const auto name = header.first_of({"space units", "units"});
  if (name.empty()) return 1e-3;
  const auto units = words(header.need(name));
  const auto found = known.find(units[0]);
  if (found == known.end() || std::any_of(units.begin(), units.end(), [&](const auto& u) { return u != units[0]; }))
    header.refuse(name, "lengths are in \"mm\", \"cm\", \"m\" or \"um\", the same along each axis", "write it in mm");
  return found->second;
}

/// Centre of the first voxel along the axes of an image that has no directions, from `axis mins`. Voxels are cells
/// unless the file says that they are points, and a cell begins half a spacing before its centre.
std::vector<double> origin_from_axes(const TextHeader& header, const std::vector<double>& spacings) {
  if (header.find("space origin"))
    header.refuse("axis mins", "the file gives a space origin as well", "remove one of them");
  auto origin = header.numbers("axis mins", 3);
  std::vector<std::string> centers(3, "cell");
  if (const auto name = header.first_of({"centers", "centerings"}); !name.empty()) {
    centers = words(lower(header.need(name)));
    if (centers.size() != 3) header.refuse(name, "must be three of cell, node, ???", "correct it");
  }
  for (int a = 0; a < 3; ++a)
    if (centers[a] != "node") origin[a] += 0.5 * spacings[a];
  return origin;
}

ImageFrame nrrd_frame(const TextHeader& header) {
  if (header.whole_numbers("dimension", 1)[0] != 3)
    throw InputError(header.path.string(), "is an image of " + printable(header.need("dimension")) + " dimensions",
                     "give a three-dimensional image of one value each");
  const auto sizes = header.whole_numbers("sizes", 3);
  const auto signs = axis_signs(header);
  const double unit = length_unit(header);
  std::vector<double> columns(9, 0), origin(3, 0);
  if (header.find("space origin")) origin = header.numbers("space origin", 3);
  if (header.find("space directions")) {
    columns = header.numbers("space directions", 9);
    if (header.find("axis mins"))
      header.refuse("axis mins", "the file gives space directions as well", "give a space origin in its place");
  } else if (header.find("spacings")) {
    const auto spacings = header.spacings("spacings");
    for (int a = 0; a < 3; ++a) columns[4 * a] = spacings[a];
    if (header.find("axis mins")) origin = origin_from_axes(header, spacings);
  } else {
    throw InputError(header.path.string(), "states no voxel spacing: neither 'space directions' nor 'spacings'",
                     "write the image again with its spacing");
  }
  std::array<Vec3<double>, 3> steps{};
  Point first{};
  for (int d = 0; d < 3; ++d) {
    for (int a = 0; a < 3; ++a) steps[a][d] = unit * signs[d] * columns[3 * a + d];
    first[d] = unit * signs[d] * origin[d];
  }
  return checked_frame({sizes[0], sizes[1], sizes[2]}, steps, first, header.path);
}

/// What an image of four dimensions has besides its voxels.
struct FourthAxis {
  std::int64_t first = 1, last = 1;  ///< entries before and after the axes of space
};

/// Takes the axis that is none of space out of the header of a four-dimensional image.
FourthAxis take_fourth_axis(TextHeader& header) {
  FourthAxis result;
  if (header.whole_numbers("dimension", 1)[0] != 4) return result;
  const auto name = header.find("space directions") ? "space directions" : "kinds";
  const auto axes = words(lower(header.need(name)));
  std::vector<std::size_t> others;
  for (std::size_t a = 0; a < axes.size(); ++a)
    if (axes[a] == "none" || (name == std::string("kinds") && axes[a] != "domain" && axes[a] != "space"))
      others.push_back(a);
  if (axes.size() != 4 || others.size() != 1 || (others[0] != 0 && others[0] != 3))
    header.refuse(name, "of four axes the first or the last one is not of space: vectors or times",
                  "write `none` for it in `space directions`");
  const auto size = header.whole_numbers("sizes", 4)[others[0]];
  if (size < 1) header.refuse("sizes", "must be above zero", "write the image again");
  (others[0] == 0 ? result.first : result.last) = size;
  header.fields.at("dimension").value = std::to_string(3);
  for (const char* field : {"sizes", "space directions", "spacings", "axis mins", "centers", "centerings", "units"}) {
    if (!header.find(field)) continue;
    std::string kept;
    const auto entries = words(header.need(field));
    if (entries.size() != 4) header.refuse(field, "must have four entries without blanks in them", "correct it");
    for (std::size_t a = 0; a < 4; ++a)
      if (a != others[0]) kept += (kept.empty() ? "" : " ") + entries[a];
    header.fields.at(field).value = kept;
  }
  return result;
}

/// How many lines or bytes of the data file come before the data.
std::int64_t skipped(const TextHeader& header, std::initializer_list<const char*> names, std::int64_t least) {
  const auto name = header.first_of(names);
  if (name.empty()) return 0;
  const auto value = header.whole_numbers(name, 1)[0];
  if (value < least) header.refuse(name, fmt::format("must be at least {}", least), "correct it");
  return value;
}

DataPlace data_place(const TextHeader& header) {
  const auto name = header.first_of({"data file", "datafile"});
  if (name.empty()) return {header.path, header.data_offset};
  const auto& file = header.need(name);
  const auto parts = words(file);
  if (parts[0] == "LIST" || (parts.size() >= 4 && parts[0].find('%') != std::string::npos))
    header.refuse(name, "its data lie in several files", "write it to a single file");
  return {header.path.parent_path() / file, 0};
}

/// Puts `place` after the lines that are skipped.
void skip_lines(DataPlace& place, std::int64_t lines, const TextHeader& header) {
  if (lines == 0) return;
  DataStream data(place, Packing::raw);
  for (char c = 0; lines > 0 && data.read(&c, 1) == 1; ++place.offset) lines -= c == '\n' ? 1 : 0;
  if (lines > 0)
    header.refuse(header.first_of({"line skip", "lineskip"}), fmt::format("the data file has {} lines less", lines),
                  "correct it");
}

/// Puts the data of a file that says `byte skip: -1`: at its end.
void place_at_end(DataPlace& place, std::int64_t bytes) {
  std::error_code none;
  const auto size = std::filesystem::file_size(place.file, none);
  // A file that is too short, or is none, is told by reading it.
  if (!none && static_cast<std::int64_t>(size) > bytes + place.offset)
    place.offset = static_cast<std::int64_t>(size) - bytes;
}

bool big_endian(const TextHeader& header, ValueType type) {
  if (bytes_of(type) == 1) return false;
  const auto order = lower(header.need("endian"));
  if (order != "big" && order != "little") header.refuse("endian", "must be little or big", "correct it");
  return order == "big";
}

enum class Encoding { raw, gzip, text };

Encoding encoding_of(const TextHeader& header) {
  const auto name = lower(header.need("encoding"));
  if (name == "raw") return Encoding::raw;
  if (name == "gzip" || name == "gz") return Encoding::gzip;
  if (name == "ascii" || name == "text" || name == "txt") return Encoding::text;
  header.refuse("encoding", "this encoding cannot be read", "write it with encoding raw, gzip or ascii");
}

}  // namespace

namespace {

/// The data of `count` values, at the first one.
std::unique_ptr<DataStream> open_nrrd_data(const TextHeader& header, std::int64_t count) {
  const auto encoding = encoding_of(header);
  auto place = data_place(header);
  skip_lines(place, skipped(header, {"line skip", "lineskip"}, 0), header);
  // -1 says of raw data that they are the end of the file.
  const auto bytes = skipped(header, {"byte skip", "byteskip"}, encoding == Encoding::raw ? -1 : 0);
  if (bytes == -1) place_at_end(place, count * bytes_of(nrrd_value_type(header)));
  auto data = std::make_unique<DataStream>(place, encoding == Encoding::gzip ? Packing::deflated : Packing::raw);
  if (bytes > 0 && data->skip(bytes) < bytes)
    header.refuse(header.first_of({"byte skip", "byteskip"}), "there are fewer bytes", "correct it");
  return data;
}

}  // namespace

LabelImage read_nrrd(const std::filesystem::path& path) {
  const auto header = read_nrrd_header(path);
  const auto frame = nrrd_frame(header);
  const auto type = nrrd_value_type(header);
  const auto data = open_nrrd_data(header, frame.count());
  if (encoding_of(header) == Encoding::text) return {frame, read_labels_from_text(*data, frame, path)};
  return {frame, read_labels(*data, {.type = type, .big_endian = big_endian(header, type)}, frame, path)};
}

ValueImage open_nrrd(const std::filesystem::path& path) {
  auto header = read_nrrd_header(path);
  const auto fourth = take_fourth_axis(header);
  ValueImage image;
  image.path = path;
  image.frame = nrrd_frame(header);
  image.per_voxel = fourth.first;
  image.times = fourth.last;
  check_counts(image);
  const auto type = nrrd_value_type(header);
  if (encoding_of(header) == Encoding::text)
    header.refuse("encoding", "series of numbers are read from raw or gzip", "write it with encoding raw or gzip");
  image.format = {.type = type, .big_endian = big_endian(header, type)};
  image.data = open_nrrd_data(header, image.frame.count() * image.per_voxel * image.times);
  return image;
}

void write_nrrd(const LabelImage& image, const std::filesystem::path& path) {
  const auto& frame = image.frame;
  const auto vector = [](const Vec3<double>& v) {
    return fmt::format("({:.17g},{:.17g},{:.17g})", 1e3 * v[0], 1e3 * v[1], 1e3 * v[2]);
  };
  std::string text = fmt::format(
      "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: {} {} {}\n"
      "space directions: {} {} {}\nspace units: \"mm\" \"mm\" \"mm\"\nspace origin: {}\nkinds: domain domain domain\n"
      "endian: little\nencoding: gzip\n",
      frame.size[0], frame.size[1], frame.size[2], vector(frame.steps[0]), vector(frame.steps[1]),
      vector(frame.steps[2]), vector(frame.origin));
  const auto data = compressed(bytes_from_labels(image.labels), true);
  if (lower(path.extension().string()) == ".nhdr") {
    auto beside = path;
    beside.replace_extension(".raw.gz");
    files::write_atomically(beside, data);
    files::write_atomically(path, text + "data file: " + beside.filename().string() + "\n");
  } else {
    files::write_atomically(path, text + "\n" + data);
  }
}

}  // namespace tunica::imaging
