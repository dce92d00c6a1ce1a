#include <algorithm>
#include <array>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/field_io/field_file.hpp"
#include "tunica/field_io/hdf5_handles.hpp"

namespace tunica::field_io {

namespace {

constexpr hsize_t longest_chunk = 32768;  ///< tuples
constexpr unsigned deflate_level = 1;     ///< the next ones take longer and save 1 to 4 %

/// A file that exists in memory only, until its bytes are taken.
class Image {
 public:
  Image() {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "no property list");
    checked(H5Pset_fapl_core(access, std::size_t{1} << 20, false), "no file in memory");
    file_ = Handle(H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "no file in memory");
    group_ = make_group(file_, "VTKHDF");
    set_attribute("Version", std::array<std::int64_t, 2>{1, 0});
    set_type();
  }

  hid_t group() const { return group_; }
  static Handle make_group(hid_t in, const char* name) {
    return {H5Gcreate2(in, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "no group"};
  }

  void set_attribute(const char* name, const std::array<std::int64_t, 2>& values) {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "no space");
    write_attribute(name, H5T_STD_I64LE, space, H5T_NATIVE_INT64, values.data());
  }
  void set_attribute(const char* name, double value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "no space");
    write_attribute(name, H5T_IEEE_F64LE, space, H5T_NATIVE_DOUBLE, &value);
  }

  /// `rows` of `columns`; one column makes one dimension.
  template <class T>
  void write(hid_t in, const std::string& name, hid_t type, hid_t memory_type, const T* values, hsize_t rows,
             hsize_t columns) {
    const hsize_t sizes[2] = {rows, columns}, chunk[2] = {std::min(rows, longest_chunk), columns};
    const int dimensions = columns == 1 ? 1 : 2;
    const Handle space(H5Screate_simple(dimensions, sizes, nullptr), H5Sclose, "no space");
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "no property list");
    checked(H5Pset_obj_track_times(properties, false), "no property list");  // the same fields make the same bytes
    if (rows > 64) {  // packing a handful of numbers makes them longer
      checked(H5Pset_chunk(properties, dimensions, chunk), "no chunks");
      checked(H5Pset_shuffle(properties), "no shuffling");
      checked(H5Pset_deflate(properties, deflate_level), "no packing");
    }
    const Handle set(H5Dcreate2(in, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
                     "no array " + name);
    checked(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "array " + name);
  }
  void write_count(const char* name, std::size_t count) {
    const auto value = static_cast<std::int64_t>(count);
    write(group_, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value, 1, 1);
  }

  std::string bytes() {
    checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "cannot be completed");
    const auto size = H5Fget_file_image(file_, nullptr, 0);
    if (size <= 0) throw Hdf5Failure("no bytes");
    std::string result(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file_, result.data(), result.size()) != size) throw Hdf5Failure("no bytes");
    return result;
  }

 private:
  void write_attribute(const char* name, hid_t type, hid_t space, hid_t memory_type, const void* values) {
    const Handle attribute(H5Acreate2(group_, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "no attribute");
    checked(H5Awrite(attribute, memory_type, values), "attribute");
  }
  // VTK wants a text of fixed length.
  void set_type() {
    constexpr char text[] = "UnstructuredGrid";
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "no type");
    checked(H5Tset_size(type, sizeof text - 1), "no type");
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "no type");
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "no space");
    write_attribute("Type", type, space, type, text);
  }

  Handle file_, group_;
};

template <class Fill>
std::string bytes_of(const Fill& fill) {
  const Silence silence;
  try {
    Image image;
    fill(image);
    return image.bytes();
  } catch (const Hdf5Failure& failure) {
    throw SolverError(std::string("HDF5 cannot make a file of results: ") + failure.what());
  }
}

void write_arrays(Image& image, const char* group, const std::vector<Array>& arrays) {
  const Handle folder = Image::make_group(image.group(), group);
  for (const auto& a : arrays) {
    const auto columns = static_cast<hsize_t>(a.components);
    image.write(folder, a.name, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, a.values.data(), a.values.size() / columns, columns);
  }
}

constexpr const char* mesh_parts[] = {
    "NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds", "Points", "Connectivity", "Offsets", "Types"};

}  // namespace

std::string mesh_bytes(const RegionMesh& mesh) {
  if (mesh.cells.size() > std::numeric_limits<std::int32_t>::max())
    throw SolverError("a region has more elements than its results can hold (2^31 nodes of elements)");
  constexpr std::uint8_t tetrahedron = 10, quadratic_tetrahedron = 24;  // as VTK numbers them
  std::vector<std::int32_t> offsets(mesh.elements() + 1);
  for (std::size_t c = 0; c < offsets.size(); ++c)
    offsets[c] = static_cast<std::int32_t>(c * static_cast<std::size_t>(mesh.nodes_of_cell));
  const std::vector<std::uint8_t> types(mesh.elements(),
                                        mesh.nodes_of_cell == 10 ? quadratic_tetrahedron : tetrahedron);
  return bytes_of([&](Image& image) {
    const auto integers = [&](hid_t in, const char* name, const std::vector<std::int32_t>& values) {
      image.write(in, name, H5T_STD_I32LE, H5T_NATIVE_INT32, values.data(), values.size(), 1);
    };
    const auto ids = [&](const char* group, const char* name, const std::vector<std::int64_t>& values) {
      const Handle folder = Image::make_group(image.group(), group);
      image.write(folder, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(), values.size(), 1);
    };
    image.write_count("NumberOfPoints", mesh.nodes());
    image.write_count("NumberOfCells", mesh.elements());
    image.write_count("NumberOfConnectivityIds", mesh.cells.size());
    image.write(image.group(), "Points", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, mesh.points.data(), mesh.nodes(), 3);
    integers(image.group(), "Connectivity", mesh.cells);
    integers(image.group(), "Offsets", offsets);
    image.write(image.group(), "Types", H5T_STD_U8LE, H5T_NATIVE_UINT8, types.data(), types.size(), 1);
    ids("PointData", "node", mesh.node_ids);
    ids("CellData", "element", mesh.element_ids);
  });
}

std::string instant_bytes(const Instant& instant, const std::string& mesh_file) {
  return bytes_of([&](Image& image) {
    image.set_attribute("time [s]", instant.time);
    for (const char* part : mesh_parts)
      checked(H5Lcreate_external(mesh_file.c_str(), (std::string("/VTKHDF/") + part).c_str(), image.group(), part,
                                 H5P_DEFAULT, H5P_DEFAULT),
              "no link to the mesh");
    write_arrays(image, "PointData", instant.points);
    write_arrays(image, "CellData", instant.cells);
  });
}

}  // namespace tunica::field_io
