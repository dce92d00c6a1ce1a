#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <vector>

#include "bindings.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::python {

namespace py = pybind11;

namespace {

namespace fs = std::filesystem;

/// Column by header, in the order of the file; numbers that are not there are nan.
py::dict read_table(const fs::path& file, const std::string& remedy) {
  const files::CsvColumns table = files::read_csv(file, remedy, files::Gaps::allowed);
  py::dict columns;
  for (std::size_t k = 0; k < table.headers.size(); ++k)
    columns[py::str(table.headers[k])] =
        py::array_t<double>(static_cast<py::ssize_t>(table.columns[k].size()), table.columns[k].data());
  return columns;
}

/// (time [s], file) of each entry.
std::vector<std::pair<double, std::string>> read_series(const fs::path& file) {
  std::vector<std::pair<double, std::string>> entries;
  for (const auto& e : field_io::read_series(file)) entries.emplace_back(e.time, e.file);
  return entries;
}

/// (count, components), or (count,) of one component.
template <class To, class From>
py::array_t<To> array(const std::vector<From>& values, std::size_t components) {
  py::array_t<To> result(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), result.mutable_data());
  if (components == 1) return result;
  return result.reshape({static_cast<py::ssize_t>(values.size() / components), static_cast<py::ssize_t>(components)});
}

/// Points, cells, numbers of nodes and elements in the mesh of the case.
py::tuple read_mesh(const fs::path& file) {
  const field_io::RegionMesh mesh = field_io::FieldFile(file).read_mesh();
  return py::make_tuple(array<double>(mesh.points, 3),
                        array<std::int64_t>(mesh.cells, static_cast<std::size_t>(mesh.nodes_of_cell)),
                        array<std::int64_t>(mesh.node_ids, 1), array<std::int64_t>(mesh.element_ids, 1));
}

/// Arrays of the nodes and of the cells, in the units of the file.
py::tuple read_fields(const fs::path& path) {
  const field_io::FieldFile file(path);
  py::dict points, cells;
  for (const auto& head : file.point_arrays())
    points[py::str(head.name)] = array<double>(file.read_points(head.name), static_cast<std::size_t>(head.components));
  for (const auto& head : file.cell_arrays())
    cells[py::str(head.name)] = array<double>(file.read_cells(head.name), static_cast<std::size_t>(head.components));
  return py::make_tuple(points, cells);
}

}  // namespace

void bind_results(py::module_& m) {
  m.def("read_table", &read_table);
  m.def("read_series", &read_series);
  m.def("read_mesh", &read_mesh);
  m.def("read_fields", &read_fields);
}

}  // namespace tunica::python
