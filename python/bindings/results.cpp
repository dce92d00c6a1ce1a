#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <vector>

#include "bindings.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/series_file.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

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
  for (const auto& e : files::read_pvd(file)) entries.emplace_back(e.time, e.file);
  return entries;
}

py::tuple read_pieces(const fs::path& file) {
  const mesh_io::VtkPieces pieces = mesh_io::read_vtk_pieces(file);
  return py::make_tuple(pieces.files, pieces.point_arrays, pieces.cell_arrays);
}

template <class T, class From>
py::array_t<T> array(const From& from) {
  py::array_t<T> result(static_cast<py::ssize_t>(from.size()));
  std::copy(from.begin(), from.end(), result.mutable_data());
  return result;
}

template <class Fields>
py::dict arrays(const Fields& fields, std::size_t count) {
  py::dict result;
  for (const auto& field : fields) {
    const auto components = static_cast<py::ssize_t>(field.values.size() / std::max<std::size_t>(count, 1));
    py::array_t<double> values = array<double>(field.values);
    if (components != 1) values = values.reshape({static_cast<py::ssize_t>(count), components});
    result[py::str(field.name)] = values;
  }
  return result;
}

/// Points, types, offsets, connectivity, point arrays, cell arrays of a .vtu, in its units.
py::tuple read_volume(const fs::path& file, const std::vector<std::string>& point_arrays,
                      const std::vector<std::string>& cell_arrays) {
  const mesh_io::VtkCells cells = mesh_io::read_vtk_volume(file, cell_arrays, point_arrays);
  py::array_t<double> points({static_cast<py::ssize_t>(cells.points.size()), py::ssize_t{3}});
  for (std::size_t k = 0; k < cells.points.size(); ++k)
    std::copy(cells.points[k].x, cells.points[k].x + 3, points.mutable_data() + 3 * k);
  return py::make_tuple(points, array<std::uint8_t>(cells.types), array<std::int64_t>(cells.offsets),
                        array<std::int64_t>(cells.connectivity), arrays(cells.point_fields, cells.points.size()),
                        arrays(cells.fields, cells.types.size()));
}

}  // namespace

void bind_results(py::module_& m) {
  m.def("read_table", &read_table);
  m.def("read_series", &read_series);
  m.def("read_pieces", &read_pieces);
  m.def("read_volume", &read_volume);
}

}  // namespace tunica::python
