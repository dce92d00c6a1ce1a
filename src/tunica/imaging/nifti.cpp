// NIfTI by VTK. Its x points to the right and its y to the front of the patient.
#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <zlib.h>

#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/imaging/image_formats.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"

namespace tunica::imaging {

namespace {

constexpr double sign[3] = {-1, -1, 1};  // of NIfTI's axes along the patient axes

/// Metres in a unit of the file; the standard unit of an image that states none is mm.
double length_unit(vtkNIFTIImageHeader* header) {
  switch (header->GetXYZTUnits() & 7) {
    case vtkNIFTIImageHeader::UnitsMeter:
      return 1;
    case vtkNIFTIImageHeader::UnitsMicron:
      return 1e-6;
    default:
      return 1e-3;
  }
}

ImageFrame read_frame(vtkNIFTIImageReader* reader, vtkImageData* data, const std::filesystem::path& path) {
  vtkNIFTIImageHeader* header = reader->GetNIFTIHeader();
  // The scanner's own transformation is that of sform where a file has both.
  vtkMatrix4x4* matrix = reader->GetSFormMatrix() ? reader->GetSFormMatrix() : reader->GetQFormMatrix();
  if (!matrix)
    throw InputError(path.string(), "states no orientation: qform_code and sform_code are 0",
                     "write the image again with its orientation");
  const double unit = length_unit(header);
  std::array<Vec3<double>, 3> steps{};
  Point origin{};
  Size3 size{};
  for (int a = 0; a < 3; ++a) {
    size[a] = data->GetDimensions()[a];
    // VTK puts 1 in the place of a spacing that is missing.
    const double spacing = header->GetPixDim(a + 1) == 0 ? 0 : data->GetSpacing()[a];
    for (int d = 0; d < 3; ++d) steps[a][d] = unit * sign[d] * matrix->GetElement(d, a) * spacing;
    origin[a] = unit * sign[a] * matrix->GetElement(a, 3);
  }
  return checked_frame(size, steps, origin, path);
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
  vtkNew<vtkNIFTIImageReader> reader;
  const mesh_io::FirstVtkMessage message(reader.Get());
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  vtkDataArray* values = data->GetPointData()->GetScalars();
  if (!message.text().empty() || !values)
    throw InputError(path.string(), "cannot be read: " + message.text(), "check how it was made");
  if (values->GetNumberOfComponents() != 1)
    throw InputError(path.string(), fmt::format("holds {} values for each voxel", values->GetNumberOfComponents()),
                     "give a three-dimensional image of one label for each voxel");
  LabelImage image{read_frame(reader, data, path), {}};
  // A slope of 0 says that values are not scaled.
  const bool scaled = reader->GetRescaleSlope() != 0;
  const double slope = scaled ? reader->GetRescaleSlope() : 1, intercept = scaled ? reader->GetRescaleIntercept() : 0;
  image.labels.resize(values->GetNumberOfTuples());
  for (std::int64_t i = 0; i < std::ssize(image.labels); ++i)
    image.labels[i] = label_from_value(slope * values->GetComponent(i, 0) + intercept, i, path);
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
    for (int d = 0; d < 3; ++d) matrix->SetElement(d, a, 1e3 * sign[d] * frame.steps[a][d] / spacing[a]);
    matrix->SetElement(a, 3, 1e3 * sign[a] * frame.origin[a]);
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
