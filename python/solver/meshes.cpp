#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "session.hpp"
#include "solver.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/fibres/fibres.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"

namespace tunica::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

using artifacts::CheckedMesh;

config::Origin origin_of(const fs::path& file) { return {.name = file.string(), .folder = file.parent_path()}; }

std::unique_ptr<CheckedMesh> read_mesh(const std::string& yaml, const fs::path& file,
                                       const std::vector<std::string>& fields) {
  const py::gil_scoped_release released;
  const auto settings = config::parse_text(case_file::MeshSettings::schema(), yaml, origin_of(file)).value;
  return std::make_unique<CheckedMesh>(artifacts::load_meshes(settings, fields));
}

const mesh::FaceData& face_of(const CheckedMesh& checked, const std::string& name) {
  std::string names;
  for (const auto& face : checked.data.faces) {
    if (face.name == name) return face;
    names += (names.empty() ? "" : ", ") + face.name;
  }
  throw InputError("face " + name, "the mesh has no face of this name", "name one of: " + names);
}

/// Name, kind, and the range of its elements.
py::list mesh_regions(const CheckedMesh& checked) {
  py::list list;
  for (const auto& r : checked.data.regions)
    list.append(
        py::make_tuple(r.name, r.kind == mesh::RegionKind::lumen ? "lumen" : "wall", r.first_element, r.end_element));
  return list;
}

py::dict fields(const py::object& self) {
  const auto& data = self.cast<const CheckedMesh&>().data;
  py::dict found;
  for (const auto& field : data.fields) {
    const auto elements = static_cast<py::ssize_t>(data.tetrahedra.size());
    found[py::str(field.name)] = view(field.values.data(), {elements, field.components}, {field.components, 1}, self);
  }
  return found;
}

py::tuple make_mesh(const std::string& yaml, const fs::path& file, const fs::path& folder, bool overwrite,
                    const py::object& say) {
  const auto speak = speaker(say);
  stages::WrittenMesh written;
  {
    const py::gil_scoped_release released;
    auto parsed = config::parse_text(case_file::MeshCase::schema(), yaml, origin_of(file));
    for (const auto& warning : parsed.warnings) speak("warning: " + format(warning));
    parsed.value.output = folder;
    written = stages::mesh_to_files(parsed.value, overwrite, speak);
  }
  return py::make_tuple(written.text, written.summary);
}

std::string make_axes(const std::string& yaml, const fs::path& file, const fs::path& folder, bool overwrite,
                      const py::object& comm, const py::object& say) {
  const OwnComm own(comm);
  const auto speak = speaker(parallel::rank(own) == 0 ? say : py::none());
  const py::gil_scoped_release released;
  return stages::fibres::fibres_to_files({.file = file, .text = yaml, .output = folder, .overwrite = overwrite}, own,
                                         speak);
}

}  // namespace

void bind_meshes(py::module_& m) {
  py::class_<CheckedMesh>(m, "MeshData")
      .def_property_readonly("report", [](const CheckedMesh& c) { return c.report; })
      .def_property_readonly("warnings", [](const CheckedMesh& c) { return c.warnings; })
      .def_property_readonly(
          "points", [](const py::object& self) { return rows<double>(self.cast<CheckedMesh&>().data.points, self); })
      .def_property_readonly(
          "elements",
          [](const py::object& self) { return rows<std::int64_t>(self.cast<CheckedMesh&>().data.tetrahedra, self); })
      .def_property_readonly("regions", mesh_regions)
      .def_property_readonly("faces",
                             [](const CheckedMesh& c) {
                               std::vector<std::string> names;
                               for (const auto& face : c.data.faces) names.push_back(face.name);
                               return names;
                             })
      .def("face",
           [](const py::object& self, const std::string& name) {
             return rows<std::int64_t>(face_of(self.cast<CheckedMesh&>(), name).triangles, self);
           })
      .def_property_readonly("fields", fields);
  m.def("read_mesh", read_mesh);
  m.def("make_mesh", make_mesh);
  m.def("make_axes", make_axes);
}

}  // namespace tunica::python
