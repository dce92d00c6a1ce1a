// MetaImage: a header of `Key = Value`, lengths in mm along patient axes. The numbers of TransformMatrix are the
// directions of the image axes, one after the other.
#include <fmt/format.h>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/imaging/header_file.hpp"
#include "tunica/imaging/image_formats.hpp"
#include "tunica/imaging/voxel_data.hpp"

namespace tunica::imaging {

namespace {

TextHeader read_metaimage_header(const std::filesystem::path& path) {
  TextHeader header{.path = path};
  HeaderLines lines(path);
  while (lines.next()) {
    const auto& line = lines.text();
    if (line.empty()) continue;
    const auto equals = line.find('=');
    if (equals == std::string::npos)
      throw InputError(fmt::format("{}:{}", path.string(), lines.number()),
                       fmt::format("'{}' is no line of a MetaImage header", printable(line)),
                       "write `Key = Value`, and ElementDataFile as the last one");
    const auto key = lower(trimmed(line.substr(0, equals))), value = trimmed(line.substr(equals + 1));
    // Only notes may be empty, such as Comment.
    if (!value.empty() || key == "elementdatafile") header.add(key, value, lines.number());
    if (key == "elementdatafile") {  // always the last one
      header.data_offset = lines.offset();
      return header;
    }
  }
  throw InputError(path.string(), "is no MetaImage file: it names no ElementDataFile", "check how it was made");
}

/// Values begin like true or like false.
bool flag(const TextHeader& header, const std::string& name, bool otherwise) {
  const auto* value = header.find(name);
  if (!value) return otherwise;
  const auto first = lower(*value)[0];
  if (first != 't' && first != '1' && first != 'f' && first != '0')
    header.refuse(name, "must be True or False", "correct it");
  return first == 't' || first == '1';
}

ValueType metaimage_value_type(const TextHeader& header) {
  static const std::map<std::string, ValueType> types = {
      {"met_char", ValueType::int8},       {"met_uchar", ValueType::uint8},       {"met_short", ValueType::int16},
      {"met_ushort", ValueType::uint16},   {"met_int", ValueType::int32},         {"met_uint", ValueType::uint32},
      {"met_long_long", ValueType::int64}, {"met_ulong_long", ValueType::uint64}, {"met_float", ValueType::float32},
      {"met_double", ValueType::float64}};
  const auto found = types.find(lower(header.need("elementtype")));
  if (found != types.end()) return found->second;
  header.refuse("elementtype", "such values cannot be read", "write the labels as whole numbers");
}

/// Numbers by the first of several names that the header has: the same thing has had several names.
std::vector<double> any_numbers(const TextHeader& header, std::initializer_list<const char*> names,
                                const std::vector<double>& otherwise) {
  const auto name = header.first_of(names);
  return name.empty() ? otherwise : header.numbers(name, otherwise.size());
}

ImageFrame metaimage_frame(const TextHeader& header) {
  if (header.whole_numbers("ndims", 1)[0] != 3)
    throw InputError(header.path.string(), "is an image of " + printable(header.need("ndims")) + " dimensions",
                     "give a three-dimensional image");
  if (header.find("elementnumberofchannels") && header.whole_numbers("elementnumberofchannels", 1)[0] != 1)
    header.refuse("elementnumberofchannels", "a voxel has several values", "give one label for each");
  const auto spacing_name = header.first_of({"elementspacing", "elementsize"});
  if (spacing_name.empty())
    throw InputError(header.path.string(), "states no voxel spacing: no ElementSpacing",
                     "write the image again with its spacing");
  const auto size = header.whole_numbers("dimsize", 3);
  const auto spacing = header.spacings(spacing_name);
  const auto axes = any_numbers(header, {"transformmatrix", "rotation", "orientation"}, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  const auto origin = any_numbers(header, {"offset", "position", "origin"}, {0, 0, 0});
  std::array<Vec3<double>, 3> steps{};
  for (int a = 0; a < 3; ++a)
    for (int d = 0; d < 3; ++d) steps[a][d] = 1e-3 * spacing[a] * axes[3 * a + d];
  return checked_frame({size[0], size[1], size[2]}, steps, {{1e-3 * origin[0], 1e-3 * origin[1], 1e-3 * origin[2]}},
                       header.path);
}

/// What HeaderSize says of a file of data: so many bytes come before them, or with -1 all but the data.
std::int64_t foreign_header(const TextHeader& header, const std::filesystem::path& file, std::int64_t data_bytes) {
  if (!header.find("headersize")) return 0;
  const auto skip = header.whole_numbers("headersize", 1)[0];
  if (skip < -1) header.refuse("headersize", "must be -1 or more", "correct it");
  if (skip >= 0) return skip;
  if (flag(header, "compresseddata", false) || !flag(header, "binarydata", true))
    header.refuse("headersize", "-1 says where raw data begin, and these are not raw", "give the number of bytes");
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  // A file that is too short, or is none, is told by reading it.
  return error ? 0 : std::max<std::int64_t>(0, static_cast<std::int64_t>(size) - data_bytes);
}

DataPlace data_place(const TextHeader& header, std::int64_t data_bytes) {
  const auto& file = header.need("elementdatafile");
  if (lower(file) == "local") {
    if (header.find("headersize") && header.whole_numbers("headersize", 1)[0] > 0)
      header.refuse("headersize", "the data follow this header, and no other one", "remove it");
    return {header.path, header.data_offset};
  }
  if (words(file)[0] == "LIST" || file.find('%') != std::string::npos)
    header.refuse("elementdatafile", "its data lie in several files", "write it to a single file");
  const auto path = header.path.parent_path() / file;
  return {path, foreign_header(header, path, data_bytes)};
}

/// Compressed data end where the header says.
void limit_compressed(const TextHeader& header, DataPlace& place) {
  if (!header.find("compresseddatasize")) return;
  const auto stated = header.whole_numbers("compresseddatasize", 1)[0];
  if (stated < 0) header.refuse("compresseddatasize", "must be above zero", "remove it");
  if (stated == 0) return;  // as some write it who do not know
  std::error_code error;
  const auto size = std::filesystem::file_size(place.file, error);
  if (!error && static_cast<std::int64_t>(size) - place.offset < stated)
    header.refuse("compresseddatasize",
                  fmt::format("{} bytes of data are there", static_cast<std::int64_t>(size) - place.offset),
                  "copy the file again, it seems to be cut off");
  place.bytes = stated;
}

/// The data of `count` values, at the first one.
std::unique_ptr<DataStream> open_metaimage_data(const TextHeader& header, std::int64_t count) {
  const bool compressed_data = flag(header, "compresseddata", false);
  auto place = data_place(header, count * bytes_of(metaimage_value_type(header)));
  if (compressed_data) limit_compressed(header, place);
  return std::make_unique<DataStream>(place, compressed_data ? Packing::deflated : Packing::raw);
}

ValueFormat value_format(const TextHeader& header) {
  const bool big = flag(header, "binarydatabyteordermsb", false) || flag(header, "elementbyteordermsb", false);
  return {.type = metaimage_value_type(header), .big_endian = big};
}

/// Takes the fourth axis, of times, out of the header; returns its size.
std::int64_t take_times(TextHeader& header) {
  if (header.whole_numbers("ndims", 1)[0] != 4) return 1;
  const auto times = header.whole_numbers("dimsize", 4)[3];
  if (times < 1) header.refuse("dimsize", "must be above zero", "write the image again");
  const auto keep = [&](const char* name, std::size_t rows, std::size_t columns) {
    if (!header.find(name)) return;
    const auto entries = words(header.need(name));
    if (entries.size() != rows * columns)
      header.refuse(name, fmt::format("must be {} numbers", rows * columns), "correct it");
    std::string kept;
    for (std::size_t r = 0; r < std::min<std::size_t>(rows, 3); ++r)
      for (std::size_t c = 0; c < std::min<std::size_t>(columns, 3); ++c) kept += entries[r * columns + c] + " ";
    header.fields.at(name).value = trimmed(kept);
  };
  header.fields.at("ndims").value = std::to_string(3);
  for (const char* name : {"dimsize", "elementspacing", "elementsize", "offset", "position", "origin"})
    keep(name, 4, 1);
  for (const char* name : {"transformmatrix", "rotation", "orientation"}) keep(name, 4, 4);
  return times;
}

}  // namespace

LabelImage read_metaimage(const std::filesystem::path& path) {
  const auto header = read_metaimage_header(path);
  const auto frame = metaimage_frame(header);
  const auto format = value_format(header);
  const auto data = open_metaimage_data(header, frame.count());
  if (!flag(header, "binarydata", true)) return {frame, read_labels_from_text(*data, frame, path)};
  return {frame, read_labels(*data, format, frame, path)};
}

ValueImage open_metaimage(const std::filesystem::path& path) {
  auto header = read_metaimage_header(path);
  ValueImage image;
  image.path = path;
  image.times = take_times(header);
  if (header.find("elementnumberofchannels")) {
    image.per_voxel = header.whole_numbers("elementnumberofchannels", 1)[0];
    if (image.per_voxel < 1) header.refuse("elementnumberofchannels", "must be above zero", "write the image again");
    header.fields.at("elementnumberofchannels").value = std::to_string(1);
  }
  check_counts(image);
  image.frame = metaimage_frame(header);
  if (!flag(header, "binarydata", true))
    header.refuse("binarydata", "series of numbers are read from binary data", "write it as binary data");
  image.format = value_format(header);
  image.data = open_metaimage_data(header, image.frame.count() * image.per_voxel * image.times);
  return image;
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
