#include "tunica/mesh_io/simvascular.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/mesh/names.hpp"
#include "tunica/mesh/point_locator.hpp"
#include "tunica/mesh/quality.hpp"
#include "tunica/mesh_io/extent.hpp"
#include "tunica/mesh_io/quadratic_cells.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::mesh_io {

namespace {

namespace fs = std::filesystem;
using Index = std::int64_t;

/// Points in metres. Throws where a coordinate is not a finite number.
std::vector<Vec3<double>> scaled_points(const VtkCells& cells, double metres_per_unit, const std::string& where) {
  std::vector<Vec3<double>> points = cells.points;
  Index bad = 0, first_bad = -1;
  for (Index n = 0; n < std::ssize(points); ++n) {
    points[n] = metres_per_unit * points[n];
    const auto& x = points[n];
    if (!(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])) && bad++ == 0) first_bad = n;
  }
  if (bad > 0)
    throw InputError(where,
                     fmt::format("{} of {} nodes have coordinates that are not finite; the first is node {}", bad,
                                 points.size(), first_bad + 1),
                     "export the mesh again");
  return points;
}

/// Cells as arrays of N nodes. Throws when there are none, or some of another type.
template <std::size_t N>
std::vector<std::array<Index, N>> cells_of_type(const VtkCells& cells, int type, const std::string& type_name,
                                                double metres_per_unit, const std::string& where) {
  std::vector<std::array<Index, N>> result;
  std::vector<Vec3<double>> others;
  int other_type = 0;
  for (Index c = 0; c < std::ssize(cells.types); ++c) {
    const auto begin = cells.offsets[c], end = cells.offsets[c + 1];
    if (cells.types[c] == type && end - begin == static_cast<Index>(N)) {
      std::array<Index, N> nodes;
      std::copy_n(cells.connectivity.begin() + begin, N, nodes.begin());
      result.push_back(nodes);
      continue;
    }
    other_type = cells.types[c];
    others.push_back(end > begin ? metres_per_unit * cells.points[cells.connectivity[begin]] : Vec3<double>{{0, 0, 0}});
  }
  if (!others.empty())
    throw InputError(where,
                     fmt::format("{} of {} cells are not linear {} (VTK cell type {}): near {}", others.size(),
                                 cells.types.size(), type_name, other_type, mesh::list_places(others)),
                     fmt::format("export a mesh of linear {} only", type_name));
  if (result.empty()) throw InputError(where, "holds no cells", "export the mesh again");
  return result;
}

void refuse_unused_nodes(const mesh::MeshData& data, const std::string& where) {
  std::vector<bool> used(data.points.size(), false);
  for (const auto& t : data.tetrahedra)
    for (const auto n : t) used[n] = true;
  std::vector<Vec3<double>> unused;
  for (std::size_t n = 0; n < used.size(); ++n)
    if (!used[n]) unused.push_back(data.points[n]);
  if (!unused.empty())
    throw InputError(where,
                     fmt::format("{} of {} nodes belong to no tetrahedron: {}", unused.size(), used.size(),
                                 mesh::list_places(unused)),
                     "remove these nodes from the mesh");
}

void refuse_not_finite(const mesh::ElementField& field, const std::string& where) {
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (!std::isfinite(field.values[i]))
      throw InputError(where,
                       fmt::format("cell array {} is not finite in element {}", field.name,
                                   i / static_cast<std::size_t>(field.components) + 1),
                       "write the array again");
}

void refuse_not_finite(const mesh::NodeField& field, const std::string& where) {
  const auto bad = std::find_if(field.values.begin(), field.values.end(), [](double v) { return !std::isfinite(v); });
  if (bad != field.values.end())
    throw InputError(
        where, fmt::format("point array {} is not finite in point {}", field.name, bad - field.values.begin() + 1),
        "write the array again");
}

/// Point arrays of a face at the nodes of the volume.
std::vector<mesh::NodeField> fields_of_face(const std::string& face, const VtkCells& file,
                                            const std::vector<Index>& nodes, Index volume_nodes,
                                            const std::string& where) {
  std::vector<mesh::NodeField> fields;
  for (const auto& array : file.node_fields) {
    mesh::NodeField field{mesh::face_array_name(face, array.name), std::vector<double>(volume_nodes, std::nan(""))};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!std::isfinite(array.values[i]))
        throw InputError(where, fmt::format("point array {} is not finite in point {}", array.name, i + 1),
                         "write the array again");
      field.values[nodes[i]] = array.values[i];
    }
    fields.push_back(std::move(field));
  }
  return fields;
}

/// Sorts the elements by region, in the order of their numbers, and everything else of `file` that goes with them.
void sort_by_region(mesh::MeshData& data, VtkCells& file, const NamedRegions& regions, mesh::RegionKind kind,
                    const std::string& where) {
  const auto found = std::find_if(file.fields.begin(), file.fields.end(),
                                  [&](const mesh::ElementField& f) { return f.name == regions.array; });
  const std::vector<double> numbers = found->values;
  if (found->components != 1)
    throw InputError(where, fmt::format("cell array {} has {} components", regions.array, found->components),
                     "use an array of one integer per cell");
  std::map<int, std::vector<std::size_t>> members;
  for (std::size_t e = 0; e < numbers.size(); ++e) {
    if (numbers[e] != std::round(numbers[e]) || std::abs(numbers[e]) > std::numeric_limits<int>::max())
      throw InputError(where,
                       fmt::format("{} = {} in element {}, no number of a region", regions.array, numbers[e], e + 1),
                       "use an array of region numbers");
    members[static_cast<int>(std::lround(numbers[e]))].push_back(e);
  }
  for (const auto& [number, list] : members)
    if (!regions.names.contains(number))
      throw InputError(where,
                       fmt::format("{} elements have {} = {}, which has no name", list.size(), regions.array, number),
                       "name every number that occurs");
  std::vector<std::size_t> order;
  data.regions.clear();
  for (const auto& [number, name] : regions.names) {
    if (!members.contains(number))
      throw InputError(where, fmt::format("no element has {} = {}, called {}", regions.array, number, name),
                       "correct the number, or leave it out");
    const auto first = std::ssize(order);
    order.insert(order.end(), members[number].begin(), members[number].end());
    data.regions.push_back({name, kind, first, std::ssize(order)});
  }
  const auto tetrahedra = data.tetrahedra;
  const auto ids = file.global_element_ids;
  for (std::size_t e = 0; e < order.size(); ++e) {
    data.tetrahedra[e] = tetrahedra[order[e]];
    if (!ids.empty()) file.global_element_ids[e] = ids[order[e]];
  }
  if (ids.empty())  // then the position in the file is the ID
    for (const auto e : order) file.global_element_ids.push_back(static_cast<Index>(e) + 1);
  for (auto& field : file.fields) {
    const auto values = field.values;
    const auto n = static_cast<std::size_t>(field.components);
    for (std::size_t e = 0; e < order.size(); ++e)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(order[e] * n), n,
                  field.values.begin() + static_cast<std::ptrdiff_t>(e * n));
  }
}

/// Position of each global ID; empty when the file has no IDs, and then ID - 1 is the position.
class IdMap {
 public:
  IdMap(const std::vector<Index>& ids, Index size) : size_(size) {
    for (Index i = 0; i < std::ssize(ids); ++i) position_.emplace(ids[i], i);
  }
  Index operator()(Index id) const {  ///< -1 for an unknown ID
    if (position_.empty()) return id >= 1 && id <= size_ ? id - 1 : -1;
    const auto found = position_.find(id);
    return found == position_.end() ? -1 : found->second;
  }

 private:
  Index size_;
  std::unordered_map<Index, Index> position_;
};

/// What the faces of one volume are matched against.
struct Volume {
  const mesh::MeshData& data;
  const mesh::Boundary& boundary;
  IdMap nodes, elements;
  std::vector<Index> boundary_nodes;
  std::vector<Vec3<double>> boundary_points;
};

Volume make_volume(const mesh::MeshData& data, const mesh::Boundary& boundary, const VtkCells& file) {
  Volume v{data,
           boundary,
           IdMap(file.global_node_ids, std::ssize(data.points)),
           IdMap(file.global_element_ids, std::ssize(data.tetrahedra)),
           {},
           {}};
  for (const auto& t : boundary.triangles())
    v.boundary_nodes.insert(v.boundary_nodes.end(), t.nodes.begin(), t.nodes.end());
  std::sort(v.boundary_nodes.begin(), v.boundary_nodes.end());
  v.boundary_nodes.erase(std::unique(v.boundary_nodes.begin(), v.boundary_nodes.end()), v.boundary_nodes.end());
  for (const auto n : v.boundary_nodes) v.boundary_points.push_back(data.points[n]);
  return v;
}

struct FaceNodes {
  std::vector<Index> nodes;  ///< of the volume, for each point of the face; -1 where there is none
  std::string how;
};

FaceNodes nodes_of_face(const Volume& volume, const VtkCells& file, const std::vector<Vec3<double>>& points,
                        const std::vector<double>& allowed) {
  FaceNodes result;
  const Index n = std::ssize(points);
  Index right = 0;
  for (Index i = 0; i < std::ssize(file.global_node_ids); ++i) {
    const Index node = volume.nodes(file.global_node_ids[i]);
    result.nodes.push_back(node);
    if (node >= 0 && norm(volume.data.points[node] - points[i]) <= allowed[i]) ++right;
  }
  if (right == n) {
    result.how = fmt::format("nodes by GlobalNodeID, all {} right", n);
    return result;
  }
  result.how = file.global_node_ids.empty()
                   ? std::string("nodes by coordinates, there is no GlobalNodeID")
                   : fmt::format("nodes by coordinates, since GlobalNodeID is right for {} of {} only", right, n);
  const double radius = *std::max_element(allowed.begin(), allowed.end());
  result.nodes.assign(n, -1);
  if (radius == 0) return result;  // all triangles are points: none can be on the boundary
  const mesh::PointLocator locator(volume.boundary_points, radius);
  for (Index i = 0; i < n; ++i) {
    const Index found = locator.nearest(points[i], allowed[i]);
    if (found >= 0) result.nodes[i] = volume.boundary_nodes[found];
  }
  return result;
}

std::string compare_element_ids(const Volume& volume, const VtkCells& file, const mesh::FaceData& face) {
  if (file.global_element_ids.empty()) return "no GlobalElementID";
  Index right = 0, one_low = 0;
  for (std::size_t i = 0; i < face.triangles.size(); ++i) {
    const Index found = volume.boundary.find(face.triangles[i]);
    if (found < 0) continue;
    const Index element = volume.boundary.triangles()[found].element;
    if (volume.elements(file.global_element_ids[i]) == element) ++right;
    if (volume.elements(file.global_element_ids[i] + 1) == element) ++one_low;
  }
  const auto n = face.triangles.size();
  if (one_low > 0) return fmt::format("GlobalElementID right for {} of {}, one too low for {}", right, n, one_low);
  return fmt::format("GlobalElementID right for {} of {}", right, n);
}

/// Point arrays that files besides that of the face bring.
void add_other_files(const std::string& face, const Volume& volume, const SimVascularOptions& options,
                     std::vector<mesh::NodeField>& fields) {
  const auto others = options.other_face_files.find(face);
  if (others == options.other_face_files.end()) return;
  for (const OtherFile& other : others->second) {
    auto file = read_face_cells(other.file, {other.array});
    const auto where = other.file.string();
    const auto points = scaled_points(file, options.metres_per_unit, where);
    const auto triangles = cells_of_type<3>(file, vtk_triangle, "triangles", options.metres_per_unit, where);
    auto allowed = mesh::shortest_edges(points, triangles);
    for (auto& a : allowed) a *= options.tolerance;
    const auto found = nodes_of_face(volume, file, points, allowed);
    if (std::find(found.nodes.begin(), found.nodes.end(), -1) != found.nodes.end())
      throw InputError(where, fmt::format("has points that the volume with face {} does not have", face),
                       "write the array on the face of this mesh");
    file.node_fields.at(0).name = other.name;
    for (auto& field : fields_of_face(face, file, found.nodes, std::ssize(volume.data.points), where))
      fields.push_back(std::move(field));
  }
}

/// Adds the point arrays of the face to `fields`.
mesh::FaceData read_face(const std::string& name, const fs::path& path, const Volume& volume,
                         const SimVascularOptions& options, std::vector<mesh::NodeField>& fields,
                         std::vector<std::string>& report) {
  const auto wanted = options.face_arrays.find(name);
  const auto file =
      read_face_cells(path, wanted == options.face_arrays.end() ? std::vector<std::string>{} : wanted->second);
  const auto where = path.string();
  const auto points = scaled_points(file, options.metres_per_unit, where);
  mesh::FaceData face{name, 0, {}};
  face.triangles = cells_of_type<3>(file, vtk_triangle, "triangles", options.metres_per_unit, where);
  auto allowed = mesh::shortest_edges(points, face.triangles);
  for (auto& a : allowed) a *= options.tolerance;
  const auto found = nodes_of_face(volume, file, points, allowed);
  std::vector<Vec3<double>> missing;
  for (auto& t : face.triangles)
    for (auto& n : t) {
      if (found.nodes[n] < 0) missing.push_back(points[n]);
      n = found.nodes[n];
    }
  if (!missing.empty())
    throw InputError(where,
                     fmt::format("{} corners of triangles are no boundary nodes of the volume mesh (tolerance {:g} of "
                                 "the local edge length): {}",
                                 missing.size(), options.tolerance, mesh::list_places(missing)),
                     "export faces and volume from the same mesh in the same unit");
  for (auto& field : fields_of_face(face.name, file, found.nodes, std::ssize(volume.data.points), where))
    fields.push_back(std::move(field));
  add_other_files(name, volume, options, fields);
  report.push_back(fmt::format("face {}: {} triangles; {}; {}", face.name, face.triangles.size(), found.how,
                               compare_element_ids(volume, file, face)));
  return face;
}

const OtherFile* other_file(const SimVascularOptions& options, const std::string& array) {
  for (const OtherFile& other : options.other_files)
    if (other.name == array) return &other;
  return nullptr;
}

/// A cell array of another file, whose cells have to lie where those of the volume lie.
mesh::ElementField other_field(const OtherFile& other, const VtkCells& volume) {
  auto file = read_vtk_volume(other.file, {other.array});
  const std::string where = other.file.string();
  const char* remedy = "write the array for the cells of this mesh, in their order";
  if (file.types.size() != volume.types.size())
    throw InputError(where, fmt::format("has {} cells, the volume {}", file.types.size(), volume.types.size()), remedy);
  const auto centre = [](const VtkCells& cells, std::size_t c) {
    Vec3<double> sum{{0, 0, 0}};
    const auto begin = cells.offsets[c], end = cells.offsets[c + 1];
    for (auto i = begin; i < end; ++i) sum = sum + cells.points[cells.connectivity[i]];
    return (1.0 / static_cast<double>(std::max<Index>(end - begin, 1))) * sum;
  };
  for (std::size_t c = 0; c < file.types.size(); ++c) {
    const auto here = centre(volume, c);
    const double size = norm(volume.points[volume.connectivity[volume.offsets[c]]] - here);
    if (!(norm(centre(file, c) - here) <= 0.01 * size))
      throw InputError(where, fmt::format("cell {} lies elsewhere than that of the volume", c + 1), remedy);
  }
  auto field = std::move(file.fields.at(0));
  field.name = other.name;
  return field;
}

/// The volume with the cell arrays that are wanted, wherever they stand; that of the regions comes last.
VtkCells read_volume(const MeshFiles& files, mesh::RegionKind kind, const SimVascularOptions& options) {
  auto wanted = options.fields;
  if (options.regions) wanted.push_back(options.regions->array);
  std::vector<std::string> own;
  for (const auto& array : wanted)
    if (other_file(options, array) == nullptr) own.push_back(array);
  auto file = read_vtk_volume(files.volume, own, {},
                              kind == mesh::RegionKind::lumen
                                  ? std::vector<std::string>(mesh::lumen_fields.begin(), mesh::lumen_fields.end())
                                  : std::vector<std::string>{});
  std::vector<mesh::ElementField> fields;
  auto next = file.fields.begin();
  for (const auto& array : wanted)
    if (const OtherFile* other = other_file(options, array))
      fields.push_back(other_field(*other, file));
    else
      fields.push_back(std::move(*next++));
  file.fields = std::move(fields);
  return file;
}

/// The boundary that no face holds, as one more face, where there is any.
void add_rest(const std::string& name, const mesh::Boundary& boundary, std::vector<mesh::FaceData>& faces,
              std::vector<std::string>& report) {
  std::vector<char> held(boundary.triangles().size(), 0);
  for (const auto& face : faces)
    for (const auto& t : face.triangles)
      if (const auto found = boundary.find(t); found >= 0) held[found] = 1;
  mesh::FaceData rest{name, 0, {}};
  for (std::size_t t = 0; t < held.size(); ++t)
    if (!held[t]) rest.triangles.push_back(boundary.triangles()[t].nodes);
  if (rest.triangles.empty()) return;
  report.push_back(fmt::format("face {}: {} triangles that no other face holds", name, rest.triangles.size()));
  faces.push_back(std::move(rest));
}

/// All faces; problems of all of them are thrown together.
std::vector<mesh::FaceData> read_faces(const MeshFiles& files, const Volume& volume, const SimVascularOptions& options,
                                       std::vector<mesh::NodeField>& node_fields, std::vector<std::string>& report) {
  std::vector<Problem> problems;
  std::vector<mesh::FaceData> faces;
  std::vector<mesh::PlacedName> names;
  for (const auto& [face, path] : files.faces) {
    names.push_back({face, path.string()});
    try {
      faces.push_back(read_face(face, path, volume, options, node_fields, report));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  for (auto& problem : mesh::check_names(names, "face")) problems.push_back(std::move(problem));
  if (!problems.empty()) throw InputError(std::move(problems));
  if (files.rest) add_rest(*files.rest, volume.boundary, faces, report);
  return faces;
}

}  // namespace

mesh::LoadedMesh read_mesh_files(const MeshFiles& files, mesh::RegionKind kind, const std::string& name,
                                 const SimVascularOptions& options) {
  const auto where = files.volume.string();
  if (!(options.metres_per_unit > 0 && std::isfinite(options.metres_per_unit)))
    throw InputError(where, fmt::format("length unit of {} m, must be positive", options.metres_per_unit),
                     "declare the length unit of the mesh");
  auto file = read_volume(files, kind, options);
  const Straightened straightened = keep_corners(file);
  mesh::LoadedMesh mesh;
  mesh.ten_node = straightened.any;
  if (straightened.any) mesh.report.push_back(where + ": ten-node tetrahedra, of which the corners are kept");
  if (auto bent = describe(straightened, where); !bent.empty()) mesh.warnings.push_back(std::move(bent));
  auto& data = mesh.data;
  data.points = scaled_points(file, options.metres_per_unit, where);
  data.tetrahedra = cells_of_type<4>(file, vtk_tetrahedron, "tetrahedra", options.metres_per_unit, where);
  data.regions = {{name, kind, 0, std::ssize(data.tetrahedra)}};
  for (const auto& field : file.fields) refuse_not_finite(field, where);
  for (const auto& field : file.node_fields) refuse_not_finite(field, where);
  if (!options.specimen) refuse_unlikely_size(data.points, options.metres_per_unit, where);
  refuse_unused_nodes(data, where);
  mesh.report.push_back(fmt::format("{}: {} nodes, {} tetrahedra, {} faces; GlobalNodeID {}, GlobalElementID {}", where,
                                    data.points.size(), data.tetrahedra.size(), files.faces.size(),
                                    file.global_node_ids.empty() ? "absent" : "present",
                                    file.global_element_ids.empty() ? "absent" : "present"));
  if (auto turned = mesh::orient_elements(data, where); !turned.empty()) mesh.report.push_back(std::move(turned));
  if (options.regions) {
    sort_by_region(data, file, *options.regions, kind, where);
    file.fields.pop_back();
    for (const auto& r : data.regions)
      mesh.report.push_back(fmt::format("region {}: {} tetrahedra", r.name, r.end_element - r.first_element));
  }
  data.fields = file.fields;

  const mesh::Boundary boundary(data.tetrahedra, std::ssize(data.points), where);
  const auto volume = make_volume(data, boundary, file);
  std::vector<mesh::NodeField> node_fields = std::move(file.node_fields);
  auto faces = read_faces(files, volume, options, node_fields, mesh.report);
  data.faces = std::move(faces);
  data.node_fields = std::move(node_fields);
  mesh::orient_and_check_faces(data, boundary, where);
  return mesh;
}

}  // namespace tunica::mesh_io
