#include "tunica/mesh_io/quadratic_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"

namespace tunica::mesh_io {

namespace {

using Index = std::int64_t;

constexpr double straight = 1e-3;  // of the edge: what coordinates with few digits are off

/// Ends of the edges in VTK's order of the nodes behind the corners.
constexpr int tetrahedron_edges[][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
              triangle_edges[][2] = {{0, 1}, {1, 2}, {2, 0}};

/// A kind of quadratic cells.
struct Shape {
  int quadratic, linear;
  Index corners;
  std::span<const int[2]> edges;
  Index nodes() const { return corners + std::ssize(edges); }
};

const Shape tetrahedron{vtk_quadratic_tetrahedron, vtk_tetrahedron, 4, tetrahedron_edges},
    triangle{vtk_quadratic_triangle, vtk_triangle, 3, triangle_edges};

const Shape* shape_of(const VtkCells& cells) {
  for (const Shape* shape : {&tetrahedron, &triangle}) {
    bool all = !cells.types.empty();
    for (std::size_t c = 0; c < cells.types.size() && all; ++c)
      all = cells.types[c] == shape->quadratic && cells.offsets[c + 1] - cells.offsets[c] == shape->nodes();
    if (all) return shape;
  }
  return nullptr;
}

void measure(const VtkCells& cells, const Shape& shape, std::span<const Index> nodes, Straightened& found) {
  for (std::size_t e = 0; e < shape.edges.size(); ++e) {
    const auto& a = cells.points[nodes[shape.edges[e][0]]];
    const auto& b = cells.points[nodes[shape.edges[e][1]]];
    const auto& middle = cells.points[nodes[shape.corners + static_cast<Index>(e)]];
    const double off = norm(middle - 0.5 * (a + b)), length = norm(b - a);
    if (off <= straight * length) continue;
    ++found.bent;
    if (length > 0 && off / length > found.farthest) {
      found.farthest = off / length;
      found.place = middle;
    }
  }
}

/// The values at the points that stay.
template <class T>
void select(std::vector<T>& values, const std::vector<Index>& kept, std::size_t components) {
  if (values.empty()) return;
  std::vector<T> result;
  result.reserve(kept.size() * components);
  for (const Index n : kept)
    for (std::size_t i = 0; i < components; ++i) result.push_back(values[static_cast<std::size_t>(n) * components + i]);
  values = std::move(result);
}

}  // namespace

Straightened keep_corners(VtkCells& cells) {
  Straightened found;
  const Shape* shape = shape_of(cells);
  if (shape == nullptr) return found;
  found.any = true;
  std::vector<Index> place(cells.points.size(), 0), connectivity;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const auto nodes = std::span(cells.connectivity).subspan(static_cast<std::size_t>(cells.offsets[c]));
    measure(cells, *shape, nodes, found);
    for (Index a = 0; a < shape->corners; ++a) {
      connectivity.push_back(nodes[a]);
      place[nodes[a]] = 1;
    }
  }
  // Nodes that are neither corners nor on an edge stay, too, and are reported as such.
  for (std::size_t c = 0; c < cells.types.size(); ++c)
    for (Index i = cells.offsets[c] + shape->corners; i < cells.offsets[c + 1]; ++i)
      if (place[cells.connectivity[i]] == 0) place[cells.connectivity[i]] = -1;
  std::vector<Index> kept;
  for (std::size_t n = 0; n < place.size(); ++n)
    if (place[n] >= 0) {
      place[n] = std::ssize(kept);
      kept.push_back(static_cast<Index>(n));
    }
  for (Index& node : connectivity) node = place[node];
  cells.connectivity = std::move(connectivity);
  for (std::size_t c = 0; c < cells.offsets.size(); ++c) cells.offsets[c] = static_cast<Index>(c) * shape->corners;
  std::fill(cells.types.begin(), cells.types.end(), shape->linear);
  select(cells.points, kept, 1);
  select(cells.global_node_ids, kept, 1);
  for (auto& field : cells.node_fields) select(field.values, kept, 1);
  for (auto& field : cells.point_fields) select(field.values, kept, static_cast<std::size_t>(field.components));
  return found;
}

VtkCells read_face_cells(const std::filesystem::path& path, const std::vector<std::string>& fields) {
  const bool grid = text::lower(path.extension().string()) == ".vtu";
  VtkCells cells = grid ? read_vtk_volume(path, {}, fields) : read_vtk_surface(path, fields);
  for (auto& field : cells.point_fields) {
    if (field.components != 1)
      throw InputError(path.string(),
                       fmt::format("point array {} has {} components, one is expected", field.name, field.components),
                       "give an array of numbers");
    cells.node_fields.push_back({field.name, std::move(field.values)});
  }
  cells.point_fields.clear();
  // The polygons of a .vtp file have no type.
  const Index six = triangle.nodes();
  if (!grid && std::all_of(cells.offsets.begin(), cells.offsets.end(),
                           [&, c = Index{0}](Index o) mutable { return o == six * c++; }))
    std::fill(cells.types.begin(), cells.types.end(), vtk_quadratic_triangle);
  keep_corners(cells);
  return cells;
}

std::string describe(const Straightened& straightened, const std::string& where) {
  if (straightened.bent == 0) return "";
  return fmt::format(
      "{}: {} edges of its quadratic cells are bent and become straight; the node that is farthest off the middle lies "
      "{:.2g} of the edge beside it, at ({:.6g}, {:.6g}, {:.6g})",
      where, straightened.bent, straightened.farthest, straightened.place[0], straightened.place[1],
      straightened.place[2]);
}

}  // namespace tunica::mesh_io
