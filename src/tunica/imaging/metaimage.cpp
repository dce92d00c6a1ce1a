// MetaImage: a header of `Key = Value`, lengths in mm along patient axes. The numbers of TransformMatrix are the
// directions of the image axes, one after the other.
#include <fmt/format.h>

#include "tunica/base/error.hpp"
#include "tunica/files/series_file.hpp"
#include "tunica/imaging/header_file.hpp"
#include "tunica/imaging/image_formats.hpp"

namespace tunica::imaging {

namespace {

TextHeader read_header(const std::filesystem::path& path) {
  TextHeader header{path, {}, {}};
  const std::string all = read_bytes(path);
  for (std::size_t at = 0; at < all.size();) {
    const auto end = std::min(all.find('\n', at), all.size());
    const auto line = all.substr(at, end - at);
    const auto equals = line.find('=');
    if (equals == std::string::npos) break;
    at = end + 1;
    const auto key = lower(trimmed(line.substr(0, equals)));
    header.fields[key] = trimmed(line.substr(equals + 1));
    if (key == "elementdatafile") {  // always the last one
      if (at < all.size()) header.rest = all.substr(at);
      return header;
    }
  }
  throw InputError(path.string(), "is no MetaImage file: it names no ElementDataFile", "check how it was made");
}

bool flag(const TextHeader& header, const std::string& name) {
  const auto* value = header.find(name);
  return value && (lower(*value) == "true" || *value == "1");
}

ValueType value_type(const TextHeader& header) {
  static const std::map<std::string, ValueType> types = {
      {"met_char", ValueType::int8},       {"met_uchar", ValueType::uint8},       {"met_short", ValueType::int16},
      {"met_ushort", ValueType::uint16},   {"met_int", ValueType::int32},         {"met_uint", ValueType::uint32},
      {"met_long_long", ValueType::int64}, {"met_ulong_long", ValueType::uint64}, {"met_float", ValueType::float32},
      {"met_double", ValueType::float64}};
  const auto found = types.find(lower(header.need("elementtype")));
  if (found != types.end()) return found->second;
  throw InputError(header.path.string(), "values of type '" + header.need("elementtype") + "' cannot be read",
                   "write the labels as whole numbers");
}

ImageFrame read_frame(const TextHeader& header) {
  if (header.numbers("ndims", 1)[0] != 3)
    throw InputError(header.path.string(), "is an image of " + header.need("ndims") + " dimensions",
                     "give a three-dimensional image");
  if (const auto* channels = header.find("elementnumberofchannels"); channels && *channels != "1")
    throw InputError(header.path.string(), "holds " + *channels + " values for each voxel", "give one label for each");
  if (!header.find("elementspacing"))
    throw InputError(header.path.string(), "states no voxel spacing: no ElementSpacing",
                     "write the image again with its spacing");
  // The same thing has had several names.
  const auto any = [&](std::initializer_list<const char*> names, const std::vector<double>& otherwise) {
    for (const char* name : names)
      if (header.find(name)) return header.numbers(name, otherwise.size());
    return otherwise;
  };
  const auto size = header.numbers("dimsize", 3), spacing = header.numbers("elementspacing", 3);
  const auto axes = any({"transformmatrix", "rotation", "orientation"}, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  const auto origin = any({"offset", "position", "origin"}, {0, 0, 0});
  std::array<Vec3<double>, 3> steps{};
  for (int a = 0; a < 3; ++a)
    for (int d = 0; d < 3; ++d) steps[a][d] = 1e-3 * spacing[a] * axes[3 * a + d];
  return checked_frame(
      {static_cast<std::int64_t>(size[0]), static_cast<std::int64_t>(size[1]), static_cast<std::int64_t>(size[2])},
      steps, {{1e-3 * origin[0], 1e-3 * origin[1], 1e-3 * origin[2]}}, header.path);
}

std::string read_data(const TextHeader& header) {
  const auto file = header.need("elementdatafile");
  std::string bytes;
  if (file == "LOCAL") {
    bytes = header.rest;
  } else if (file.starts_with("LIST") || file.find('%') != std::string::npos) {
    throw InputError(header.path.string(), "its data lie in several files: " + file, "write it to a single file");
  } else {
    bytes = read_bytes(header.path.parent_path() / file);
  }
  if (const auto* skip = header.find("headersize"); skip && *skip != "0")
    throw InputError(header.path.string(), "HeaderSize = " + *skip + " cannot be read",
                     "write the image without a foreign header before its data");
  return flag(header, "compresseddata") ? decompressed(bytes, header.path) : bytes;
}

}  // namespace

LabelImage read_metaimage(const std::filesystem::path& path) {
  const auto header = read_header(path);
  const auto frame = read_frame(header);
  const bool big = flag(header, "binarydatabyteordermsb") || flag(header, "elementbyteordermsb");
  return {frame, labels_from_bytes(read_data(header), value_type(header), big, frame.count(), path)};
}

void write_metaimage(const LabelImage& image, const std::filesystem::path& path) {
  const auto& frame = image.frame;
  std::string axes, spacing;
  for (const auto& step : frame.steps) {
    const double length = norm(step);
    spacing += fmt::format(" {:.17g}", 1e3 * length);
    for (int d = 0; d < 3; ++d) axes += fmt::format(" {:.17g}", step[d] / length);
  }
  const auto data = compressed(bytes_from_labels(image.labels), false);
  const std::string text = fmt::format(
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = True\n"
      "CompressedDataSize = {}\nTransformMatrix ={}\nOffset = {:.17g} {:.17g} {:.17g}\nCenterOfRotation = 0 0 0\n"
      "AnatomicalOrientation = RAI\nElementSpacing ={}\nDimSize = {} {} {}\nElementType = MET_SHORT\n"
      "ElementDataFile = ",
      data.size(), axes, 1e3 * frame.origin[0], 1e3 * frame.origin[1], 1e3 * frame.origin[2], spacing, frame.size[0],
      frame.size[1], frame.size[2]);
  if (lower(path.extension().string()) == ".mhd") {
    auto beside = path;
    beside.replace_extension(".zraw");
    files::write_atomically(beside, data);
    files::write_atomically(path, text + beside.filename().string() + "\n");
  } else {
    files::write_atomically(path, text + "LOCAL\n" + data);
  }
}

}  // namespace tunica::imaging
