// NRRD as in its definition, teem.sourceforge.net/nrrd/format.html, for one three-dimensional scalar image.
#include <fmt/format.h>

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/files/series_file.hpp"
#include "tunica/imaging/header_file.hpp"
#include "tunica/imaging/image_formats.hpp"

namespace tunica::imaging {

namespace {

TextHeader read_header(const std::filesystem::path& path) {
  TextHeader header{path, {}, {}};
  const std::string all = read_bytes(path);
  if (!all.starts_with("NRRD")) throw InputError(path.string(), "is no NRRD file", "check how it was made");
  std::size_t at = all.find('\n');
  while (at != std::string::npos) {
    const auto end = all.find('\n', ++at);
    const auto line = trimmed(all.substr(at, end == std::string::npos ? end : end - at));
    at = end;
    if (line.empty()) break;  // the data follow
    const auto colon = line.find(": ");
    if (line[0] != '#' && colon != std::string::npos)
      header.fields[lower(line.substr(0, colon))] = trimmed(line.substr(colon + 1));
  }
  if (at != std::string::npos) header.rest = all.substr(at + 1);
  return header;
}

/// NRRD has several names for a type, such as short, short int, signed short int, int16 and int16_t.
ValueType value_type(const TextHeader& header) {
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
  throw InputError(header.path.string(), "values of type '" + header.need("type") + "' cannot be read",
                   "write the labels as whole numbers");
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
  throw InputError(header.path.string(), "its space '" + *space + "' is not known",
                   "write it in left-posterior-superior or right-anterior-superior");
}

/// Metres in one unit of the space.
double length_unit(const TextHeader& header) {
  const auto* units = header.find("space units");
  if (!units || units->find("\"\"") != std::string::npos) return 1e-3;
  const auto first = units->substr(0, units->find('"', 1) + 1);
  if (first == "\"mm\"") return 1e-3;
  if (first == "\"cm\"") return 1e-2;
  if (first == "\"m\"") return 1;
  throw InputError(header.path.string(), "its space units are " + *units, "write it in mm");
}

ImageFrame read_frame(const TextHeader& header) {
  if (header.numbers("dimension", 1)[0] != 3)
    throw InputError(header.path.string(), "is an image of " + header.need("dimension") + " dimensions",
                     "give a three-dimensional image of one value each");
  const auto sizes = header.numbers("sizes", 3);
  const auto signs = axis_signs(header);
  const double unit = length_unit(header);
  std::vector<double> columns(9, 0), origin(3, 0);
  if (header.find("space directions")) {
    columns = header.numbers("space directions", 9);
  } else if (header.find("spacings")) {
    const auto spacings = header.numbers("spacings", 3);
    for (int a = 0; a < 3; ++a) columns[4 * a] = spacings[a];
  } else {
    throw InputError(header.path.string(), "states no voxel spacing: neither 'space directions' nor 'spacings'",
                     "write the image again with its spacing");
  }
  if (header.find("space origin")) origin = header.numbers("space origin", 3);
  std::array<Vec3<double>, 3> steps{};
  Point first{};
  for (int d = 0; d < 3; ++d) {
    for (int a = 0; a < 3; ++a) steps[a][d] = unit * signs[d] * columns[3 * a + d];
    first[d] = unit * signs[d] * origin[d];
  }
  return checked_frame(
      {static_cast<std::int64_t>(sizes[0]), static_cast<std::int64_t>(sizes[1]), static_cast<std::int64_t>(sizes[2])},
      steps, first, header.path);
}

/// The data as they lie in the file, beside it or after the header.
std::string stored_data(const TextHeader& header) {
  for (const char* skip : {"line skip", "byte skip", "lineskip", "byteskip"})
    if (const auto* value = header.find(skip); value && *value != "0")
      throw InputError(header.path.string(), fmt::format("'{}: {}' cannot be read", skip, *value),
                       "write the image without a foreign header before its data");
  const auto* file = header.find("data file");
  if (!file) file = header.find("datafile");
  if (!file) return header.rest;
  if (file->starts_with("LIST") || words(*file).size() != 1)
    throw InputError(header.path.string(), "its data lie in several files: " + *file, "write it to a single file");
  return read_bytes(header.path.parent_path() / *file);
}

std::vector<std::int16_t> labels_from_text(const std::string& text, std::int64_t count,
                                           const std::filesystem::path& path) {
  const auto values = words(text);
  if (std::ssize(values) < count)
    throw InputError(path.string(), fmt::format("holds {} values, its size asks for {}", values.size(), count),
                     "copy the file again, it seems to be cut off");
  std::vector<std::int16_t> labels;
  for (std::int64_t i = 0; i < count; ++i) {
    char* end = nullptr;
    const double value = std::strtod(values[i].c_str(), &end);
    labels.push_back(label_from_value(*end == '\0' ? value : std::nan(""), i, path));
  }
  return labels;
}

bool big_endian(const TextHeader& header, ValueType type) {
  if (type == ValueType::int8 || type == ValueType::uint8) return false;
  return lower(header.need("endian")) == "big";
}

}  // namespace

LabelImage read_nrrd(const std::filesystem::path& path) {
  const auto header = read_header(path);
  const auto frame = read_frame(header);
  const auto type = value_type(header);
  const auto encoding = lower(header.need("encoding"));
  if (encoding == "ascii" || encoding == "text" || encoding == "txt")
    return {frame, labels_from_text(stored_data(header), frame.count(), path)};
  const bool zipped = encoding == "gzip" || encoding == "gz";
  if (!zipped && encoding != "raw")
    throw InputError(path.string(), "its encoding '" + encoding + "' cannot be read",
                     "write it with encoding raw, gzip or ascii");
  const auto bytes = zipped ? decompressed(stored_data(header), path) : stored_data(header);
  return {frame, labels_from_bytes(bytes, type, big_endian(header, type), frame.count(), path)};
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
