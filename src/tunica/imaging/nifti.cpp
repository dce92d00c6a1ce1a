// NIfTI-1 and NIfTI-2 in one file, as in nifti1.h and nifti2.h (nifti.nimh.nih.gov). Its x points to the right and its
// y to the front of the patient. Written by VTK; its reader takes sizes for granted that a damaged header states.
#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/imaging/image_formats.hpp"
#include "tunica/imaging/voxel_data.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"

namespace tunica::imaging {

namespace {

constexpr double axis_sign[3] = {-1, -1, 1};  // of NIfTI's axes along the patient axes

/// What both versions of the header say.
struct Header {
  bool big_endian = false;
  std::int64_t size = 0;  ///< of the header in the file
  std::int64_t dim[8]{};
  int datatype = 0, bits = 0, units = 0;
  double pixdim[8]{}, vox_offset = 0;
  Scaling scaling{};
  int qform_code = 0, sform_code = 0;
  double quaternion[3]{}, qoffset[3]{}, srow[3][4]{};
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what, const std::string& remedy) {
  throw InputError(path.string(), what, remedy);
}

/// Numbers of a header at the offsets of its definition, of either byte order.
class Fields {
 public:
  Fields(const std::string& bytes, bool turn) : bytes_(bytes), turn_(turn) {}
  template <class T>
  T at(std::size_t offset) const {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + offset, sizeof(T));
    if (turn_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }
  template <class T, class To>
  void copy(std::size_t offset, To* to, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) to[i] = at<T>(offset + i * sizeof(T));
  }

 private:
  const std::string& bytes_;
  bool turn_;
};

void take_version_1(const Fields& f, Header& h) {
  f.copy<std::int16_t>(40, h.dim, 8);
  h.datatype = f.at<std::int16_t>(70);
  h.bits = f.at<std::int16_t>(72);
  f.copy<float>(76, h.pixdim, 8);
  h.vox_offset = f.at<float>(108);
  h.scaling = {f.at<float>(112), f.at<float>(116)};
  h.units = f.at<std::uint8_t>(123);
  h.qform_code = f.at<std::int16_t>(252);
  h.sform_code = f.at<std::int16_t>(254);
  f.copy<float>(256, h.quaternion, 3);
  f.copy<float>(268, h.qoffset, 3);
  f.copy<float>(280, h.srow[0], 12);
}

void take_version_2(const Fields& f, Header& h) {
  h.datatype = f.at<std::int16_t>(12);
  h.bits = f.at<std::int16_t>(14);
  f.copy<std::int64_t>(16, h.dim, 8);
  f.copy<double>(104, h.pixdim, 8);
  h.vox_offset = static_cast<double>(f.at<std::int64_t>(168));
  h.scaling = {f.at<double>(176), f.at<double>(184)};
  h.qform_code = f.at<std::int32_t>(344);
  h.sform_code = f.at<std::int32_t>(348);
  f.copy<double>(352, h.quaternion, 3);
  f.copy<double>(376, h.qoffset, 3);
  f.copy<double>(400, h.srow[0], 12);
  h.units = f.at<std::int32_t>(500);
}

Header read_header(DataStream& data, const std::filesystem::path& path) {
  std::string bytes(540, '\0');
  const auto read_to = [&](std::size_t from, std::size_t to) {
    if (data.read(bytes.data() + from, to - from) < to - from)
      refuse(path, "is shorter than the header of a NIfTI file", "copy the file again, it seems to be cut off");
  };
  read_to(0, 348);
  Header h;
  const auto first = Fields(bytes, false).at<std::int32_t>(0), turned = Fields(bytes, true).at<std::int32_t>(0);
  const bool turn = turned == 348 || turned == 540;
  h.size = turn ? turned : first;
  if (h.size != 348 && h.size != 540)
    refuse(path, fmt::format("is no NIfTI file: its header begins with {}, not 348 or 540", first),
           "check how it was made");
  h.big_endian = turn != (std::endian::native == std::endian::big);
  if (h.size == 540) read_to(348, 540);
  const auto magic = h.size == 348 ? bytes.substr(344, 4) : bytes.substr(4, 4);
  const std::string expected(h.size == 348 ? "n+1" : "n+2", 4);
  if (magic != expected)
    refuse(path, fmt::format("is no NIfTI file that holds header and image: its magic is not '{}'", expected.c_str()),
           "write header and image to one .nii file");
  if (h.size == 348)
    take_version_1(Fields(bytes, turn), h);
  else
    take_version_2(Fields(bytes, turn), h);
  return h;
}

ValueType value_type(const Header& h, const std::filesystem::path& path) {
  static const std::map<int, ValueType> types = {
      {2, ValueType::uint8},    {4, ValueType::int16},    {8, ValueType::int32},    {16, ValueType::float32},
      {64, ValueType::float64}, {256, ValueType::int8},   {512, ValueType::uint16}, {768, ValueType::uint32},
      {1024, ValueType::int64}, {1280, ValueType::uint64}};
  const auto found = types.find(h.datatype);
  if (found == types.end())
    refuse(path, fmt::format("values of its datatype {} cannot be read", h.datatype),
           "write the labels as whole numbers, one for each voxel");
  if (h.bits != 8 * bytes_of(found->second))
    refuse(
        path,
        fmt::format("its datatype {} has {} bits, its bitpix says {}", h.datatype, 8 * bytes_of(found->second), h.bits),
        "write the image again, its header is damaged");
  return found->second;
}

Size3 size_of(const Header& h, const std::filesystem::path& path) {
  const auto dimensions = h.dim[0];
  if (dimensions < 1 || dimensions > 7)
    refuse(path, fmt::format("its number of dimensions is {}, must be 1 to 7", dimensions),
           "write the image again, its header is damaged");
  if (dimensions < 3)
    refuse(path, fmt::format("is an image of {} dimensions", dimensions), "give a three-dimensional image");
  for (int d = 1; d <= dimensions; ++d)
    if (h.dim[d] < 1)
      refuse(path, fmt::format("its size along dimension {} is {}", d, h.dim[d]),
             "write the image again, its header is damaged");
  return {h.dim[1], h.dim[2], h.dim[3]};
}

/// Its size along a dimension that it may not have.
std::int64_t size_along(const Header& h, int d) { return d <= h.dim[0] ? h.dim[d] : 1; }

void require_three_dimensions(const Header& h, const std::filesystem::path& path) {
  if (size_along(h, 4) > 1)
    refuse(path, fmt::format("is an image of 4 dimensions: it holds {} times (frames), and one is meshed", h.dim[4]),
           "write the labels of one time as an image of their own");
  for (int d = 5; d <= h.dim[0]; ++d)
    if (h.dim[d] > 1)
      refuse(path, fmt::format("is an image of {} dimensions: it holds {} values for each voxel", d, h.dim[d]),
             "give a three-dimensional image of one label for each voxel");
}

/// Seconds between two frames; 0 where the header does not say.
double time_step(const Header& h) {
  if (size_along(h, 4) < 2 || !(h.pixdim[4] > 0)) return 0;
  switch (h.units & 56) {
    case 8:
      return h.pixdim[4];
    case 16:
      return 1e-3 * h.pixdim[4];
    case 24:
      return 1e-6 * h.pixdim[4];
    default:
      return 0;
  }
}

/// Metres in a unit of the file; the standard unit of an image that states none is mm.
double length_unit(const Header& h, const std::filesystem::path& path) {
  switch (h.units & 7) {
    case 0:
    case 2:
      return 1e-3;
    case 1:
      return 1;
    case 3:
      return 1e-6;
    default:
      refuse(path, fmt::format("its unit of length has the code {}, known are 1 (m), 2 (mm), 3 (micron)", h.units & 7),
             "write it in mm");
  }
}

/// Rotation by a quaternion whose first number is left out.
Mat3<double> rotation(const double (&q)[3]) {
  double b = q[0], c = q[1], d = q[2], a = 1 - (b * b + c * c + d * d);
  if (a < 1e-7) {  // a half turn, but for rounding
    const double length = std::sqrt(b * b + c * c + d * d);
    a = 0, b /= length, c /= length, d /= length;
  } else {
    a = std::sqrt(a);
  }
  Mat3<double> r;
  r(0, 0) = a * a + b * b - c * c - d * d;
  r(1, 1) = a * a + c * c - b * b - d * d;
  r(2, 2) = a * a + d * d - c * c - b * b;
  r(0, 1) = 2 * (b * c - a * d), r(1, 0) = 2 * (b * c + a * d);
  r(0, 2) = 2 * (b * d + a * c), r(2, 0) = 2 * (b * d - a * c);
  r(1, 2) = 2 * (c * d - a * b), r(2, 1) = 2 * (c * d + a * b);
  return r;
}

ImageFrame read_frame(const Header& h, const std::filesystem::path& path) {
  if (h.sform_code <= 0 && h.qform_code <= 0)
    refuse(path, "states no orientation: qform_code and sform_code are 0",
           "write the image again with its orientation");
  const auto size = size_of(h, path);
  const double unit = length_unit(h, path);
  // The scanner's own transformation is that of sform where a file has both.
  const bool sform = h.sform_code > 0;
  const auto turn = rotation(h.quaternion);
  std::array<Vec3<double>, 3> steps{};
  Point origin{};
  for (int d = 0; d < 3; ++d) {
    for (int a = 0; a < 3; ++a) {
      const double mirror = a == 2 && h.pixdim[0] < 0 ? -1 : 1;
      steps[a][d] = unit * axis_sign[d] * (sform ? h.srow[d][a] : mirror * turn(d, a) * h.pixdim[a + 1]);
    }
    origin[d] = unit * axis_sign[d] * (sform ? h.srow[d][3] : h.qoffset[d]);
  }
  if (!sform)
    for (int a = 1; a <= 3; ++a)
      if (!(h.pixdim[a] > 0))
        refuse(path, fmt::format("its voxel spacing along axis {} is {}, must be above zero", a, h.pixdim[a]),
               "write the image again with its spacing");
  return checked_frame(size, steps, origin, path);
}

/// A slope of 0, or one that is no number, says that values are not scaled.
Scaling scaling_of(const Header& h, const std::filesystem::path& path) {
  const auto& [slope, intercept] = h.scaling;
  if (slope == 0 || std::isnan(slope)) return {};
  if (!std::isfinite(slope) || !std::isfinite(intercept))
    refuse(path, fmt::format("scales its values by {} and adds {} (scl_slope, scl_inter)", slope, intercept),
           "write the labels without a scaling: scl_slope 0");
  return h.scaling;
}

/// From the end of the header to the first voxel.
void skip_to_voxels(DataStream& data, const Header& h, const std::filesystem::path& path) {
  constexpr double most = 1 << 30;
  const double least = static_cast<double>(h.size) + 4;  // four bytes tell whether extensions follow
  if (!(h.vox_offset >= least && h.vox_offset <= most) || h.vox_offset != std::floor(h.vox_offset))
    refuse(path,
           fmt::format("its voxels begin after {} bytes (vox_offset), must be a whole number from {} to {}",
                       h.vox_offset, least, most),
           "write the image again, its header is damaged");
  const auto distance = static_cast<std::int64_t>(h.vox_offset) - h.size;
  if (const auto skipped = data.skip(distance); skipped < distance)
    refuse(path, fmt::format("its voxels begin after {} bytes (vox_offset), it has {}", h.vox_offset, h.size + skipped),
           "copy the file again, it seems to be cut off");
}

constexpr std::int64_t nifti_header = 352;  // bytes

/// What a file, compressed or not, holds until its end or until it is damaged [bytes].
std::int64_t uncompressed_size(const std::filesystem::path& path) {
  gzFile file = gzopen(path.c_str(), "rb");
  if (!file) return 0;
  std::vector<char> block(1 << 16);
  std::int64_t size = 0;
  for (int n = 1; n > 0;) {
    n = gzread(file, block.data(), static_cast<unsigned>(block.size()));
    if (n > 0) size += n;
  }
  gzclose(file);
  return size;
}

}  // namespace

LabelImage read_nifti(const std::filesystem::path& path) {
  DataStream data({path}, Packing::detected);
  const auto header = read_header(data, path);
  const auto frame = read_frame(header, path);
  require_three_dimensions(header, path);
  const ValueFormat format{value_type(header, path), header.big_endian, scaling_of(header, path)};
  skip_to_voxels(data, header, path);
  return {frame, read_labels(data, format, frame, path)};
}

ValueImage open_nifti(const std::filesystem::path& path) {
  ValueImage image;
  image.path = path;
  image.data = std::make_unique<DataStream>(DataPlace{path}, Packing::detected);
  const auto header = read_header(*image.data, path);
  image.frame = read_frame(header, path);
  for (int d = 6; d <= header.dim[0]; ++d)
    if (header.dim[d] > 1)
      refuse(path, fmt::format("has {} entries along dimension {}", header.dim[d], d),
             "write times along dimension 4 and components along dimension 5");
  image.times = size_along(header, 4);
  image.components = size_along(header, 5);
  check_counts(image);
  image.time_step = time_step(header);
  image.format = {value_type(header, path), header.big_endian, scaling_of(header, path)};
  skip_to_voxels(*image.data, header, path);
  return image;
}

void write_nifti(const LabelImage& image, const std::filesystem::path& path) {
  const auto& frame = image.frame;
  vtkNew<vtkShortArray> values;
  values->SetName("label");
  // VTK only reads the array, and it does not outlive this function.
  values->SetArray(const_cast<std::int16_t*>(image.labels.data()), std::ssize(image.labels), 1);
  vtkNew<vtkImageData> data;
  data->SetDimensions(static_cast<int>(frame.size[0]), static_cast<int>(frame.size[1]),
                      static_cast<int>(frame.size[2]));
  data->GetPointData()->SetScalars(values);
  vtkNew<vtkMatrix4x4> matrix;
  double spacing[3];
  for (int a = 0; a < 3; ++a) {
    spacing[a] = 1e3 * norm(frame.steps[a]);
    for (int d = 0; d < 3; ++d) matrix->SetElement(d, a, 1e3 * axis_sign[d] * frame.steps[a][d] / spacing[a]);
    matrix->SetElement(a, 3, 1e3 * axis_sign[a] * frame.origin[a]);
  }
  data->SetSpacing(spacing);
  vtkNew<vtkNIFTIImageWriter> writer;
  const mesh_io::FirstVtkMessage message(writer.Get());
  writer->SetInputData(data);
  writer->SetSFormMatrix(matrix);
  const std::string ending = path.extension() == ".gz" ? ".nii.gz" : ".nii";
  files::write_atomically(path, ending, [&](const std::filesystem::path& temporary) {
    writer->SetFileName(temporary.c_str());
    writer->Write();
    const std::int64_t expected = nifti_header + std::ssize(image.labels) * 2;
    const bool failed = !message.text().empty() || writer->GetErrorCode() != 0;
    if (failed || uncompressed_size(temporary) < expected)
      throw SolverError(fmt::format("cannot write {}: {}", path.string(),
                                    message.text().empty() ? "the file is cut off; is the disk full, or is there a "
                                                             "limit for the size of files?"
                                                           : message.text()));
  });
}

}  // namespace tunica::imaging
