#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/field_io/field_file.hpp"
#include "tunica/field_io/hdf5_handles.hpp"

namespace tunica::field_io {

namespace fs = std::filesystem;

namespace {

constexpr const char* remedy = "run the case again with --overwrite, or copy the file again";
/// Deflate packs no tighter than this.
constexpr std::uintmax_t tightest = 1100;
constexpr int most_components = 9;

template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

/// An opened array and what its head says.
struct Set {
  Handle handle;
  std::string name;
  hsize_t rows = 0, columns = 1;
};

Set open_set(hid_t in, const std::string& name) {
  Set set{Handle(H5Dopen2(in, name.c_str(), H5P_DEFAULT), H5Dclose, fmt::format("`{}` cannot be read", name)), name};
  const Handle space(H5Dget_space(set.handle), H5Sclose, name);
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions < 1 || dimensions > 2) throw Hdf5Failure(fmt::format("`{}` is no list of numbers", name));
  hsize_t sizes[2] = {0, 1};
  H5Sget_simple_extent_dims(space, sizes, nullptr);
  set.rows = sizes[0];
  set.columns = sizes[1];
  const Handle type(H5Dget_type(set.handle), H5Tclose, name);
  const auto kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) throw Hdf5Failure(fmt::format("`{}` holds no numbers", name));
  return set;
}

template <class T>
std::vector<T> values_of(const Set& set) {
  // A damaged head may ask for any size; what is stored says what can be true.
  const auto stored = static_cast<std::uintmax_t>(H5Dget_storage_size(set.handle));
  const auto bytes = static_cast<std::uintmax_t>(set.rows) * set.columns;
  if (set.columns != 0 && bytes / set.columns != set.rows) throw Hdf5Failure(fmt::format("`{}` is cut off", set.name));
  if (bytes > (stored + 1) * tightest) throw Hdf5Failure(fmt::format("`{}` is cut off", set.name));
  std::vector<T> values(static_cast<std::size_t>(bytes));
  if (values.empty()) return values;
  if (H5Dread(set.handle, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw Hdf5Failure(fmt::format("`{}` is damaged", set.name));
  return values;
}

bool has(hid_t in, const char* name) { return H5Lexists(in, name, H5P_DEFAULT) > 0; }

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  hsize_t at = 0;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, &at, add, &names), "the list of its arrays is damaged");
  return names;
}

}  // namespace

bool is_hdf5(const fs::path& path) {
  constexpr char signature[] = "\211HDF\r\n\032\n";
  std::ifstream file(path, std::ios::binary);
  char start[8] = {};
  return file.read(start, sizeof start) && std::equal(start, start + sizeof start, signature);
}

struct FieldFile::Implementation {
  fs::path path;
  Handle file, group, points, cells;
  std::vector<ArrayHead> point_arrays, cell_arrays;
  double time = 0;

  [[noreturn]] void refuse(const std::string& what, const std::string& cure) const {
    throw InputError(path.string(), what, cure);
  }

  template <class Action>
  auto guarded(const Action& action) const {
    const Silence silence;
    try {
      return action();
    } catch (const Hdf5Failure& failure) {
      refuse(failure.what(), remedy);
    }
  }

  explicit Implementation(fs::path p) : path(std::move(p)) {
    if (!fs::exists(path)) refuse("is missing", remedy);
    if (!is_hdf5(path)) refuse("is no file of results (HDF5)", remedy);
    guarded([&] {
      file = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "is cut off or damaged");
      if (!has(file, "VTKHDF")) throw Hdf5Failure("holds no results: it has no group VTKHDF");
      group = open_group(file, "VTKHDF");
      read_time();
      points = open_group(group, "PointData");
      cells = open_group(group, "CellData");
      point_arrays = heads(points);
      cell_arrays = heads(cells);
    });
  }

  static Handle open_group(hid_t in, const char* name) {
    return {H5Gopen2(in, name, H5P_DEFAULT), H5Gclose, fmt::format("is damaged: its group {} cannot be read", name)};
  }

  void read_time() {
    if (H5Aexists(group, "time [s]") <= 0) return;
    const Handle attribute(H5Aopen(group, "time [s]", H5P_DEFAULT), H5Aclose, "its time cannot be read");
    checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, &time), "its time cannot be read");
  }

  static std::vector<ArrayHead> heads(hid_t group) {
    std::vector<ArrayHead> result;
    for (const auto& name : names_in(group)) {
      const Set set = open_set(group, name);
      if (set.columns < 1 || set.columns > most_components)
        throw Hdf5Failure(fmt::format("`{}` has {} components", text::printable(name), set.columns));
      result.push_back({name, static_cast<int>(set.columns)});
    }
    return result;
  }

  std::size_t count(const char* name) const {
    const auto values = values_of<std::int64_t>(open_set(group, name));
    if (values.size() != 1 || values[0] < 0) throw Hdf5Failure(fmt::format("`{}` is no number of one piece", name));
    return static_cast<std::size_t>(values[0]);
  }

  template <class T>
  std::vector<T> mesh_part(const char* name, std::size_t size) const {
    const Set set = open_set(group, name);
    if (set.rows * set.columns != size)
      throw Hdf5Failure(fmt::format("`{}` has {} numbers, {} are due", name, set.rows * set.columns, size));
    return values_of<T>(set);
  }

  std::vector<std::int64_t> ids(hid_t in, const char* name) const {
    if (!has(in, name)) return {};
    return values_of<std::int64_t>(open_set(in, name));
  }

  RegionMesh read_mesh() const {
    const std::size_t nodes = count("NumberOfPoints"), elements = count("NumberOfCells"),
                      corners = count("NumberOfConnectivityIds");
    RegionMesh mesh;
    mesh.points = mesh_part<float>("Points", 3 * nodes);
    mesh.cells = mesh_part<std::int32_t>("Connectivity", corners);
    mesh.nodes_of_cell = corners == 10 * elements ? 10 : 4;
    if (corners != elements * static_cast<std::size_t>(mesh.nodes_of_cell))
      throw Hdf5Failure("holds cells that are no tetrahedra");
    for (const auto node : mesh.cells)
      if (node < 0 || static_cast<std::size_t>(node) >= nodes)
        throw Hdf5Failure(fmt::format("a cell names node {}, but there are nodes 0 to {}", node, nodes - 1));
    mesh.node_ids = ids(points, "node");
    mesh.element_ids = ids(cells, "element");
    return mesh;
  }

  std::vector<float> read(hid_t in, std::string_view name) const {
    return guarded([&] {
      const Set set = open_set(in, std::string(name));
      return values_of<float>(set);
    });
  }
};

FieldFile::FieldFile(fs::path path) : implementation_(std::make_unique<Implementation>(std::move(path))) {}
FieldFile::~FieldFile() = default;
FieldFile::FieldFile(FieldFile&&) noexcept = default;
FieldFile& FieldFile::operator=(FieldFile&&) noexcept = default;

double FieldFile::time() const { return implementation_->time; }
const std::vector<ArrayHead>& FieldFile::point_arrays() const { return implementation_->point_arrays; }
const std::vector<ArrayHead>& FieldFile::cell_arrays() const { return implementation_->cell_arrays; }
RegionMesh FieldFile::read_mesh() const {
  return implementation_->guarded([&] { return implementation_->read_mesh(); });
}
std::vector<float> FieldFile::read_points(std::string_view name) const {
  return implementation_->read(implementation_->points, name);
}
std::vector<float> FieldFile::read_cells(std::string_view name) const {
  return implementation_->read(implementation_->cells, name);
}

}  // namespace tunica::field_io
