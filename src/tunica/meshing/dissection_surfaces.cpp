#include "tunica/meshing/dissection_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/geometry/contour.hpp"
#include "tunica/geometry/plane_cut.hpp"
#include "tunica/geometry/remesh.hpp"
#include "tunica/geometry/size_field.hpp"

namespace tunica::meshing {

namespace {

/// One of the model's functions, negative inside.
using Function = double geometry::DissectionModel::Values::*;

struct Samples {
  geometry::Grid lumen, outer;
};

/// Both functions at once. Where they are far from zero they are passed over in steps; no vessel begins within a step,
/// since the functions jump to their true values at least a fillet away from the surface.
Samples sample(const geometry::DissectionModel& model, double beyond, double spacing) {
  const auto [low, high] = model.box();
  geometry::Grid grid{low, spacing, {}, {}};
  for (int d = 0; d < 3; ++d) grid.size[d] = static_cast<std::int64_t>((high[d] - low[d]) / spacing) + 2;
  grid.values.resize(grid.size[0] * grid.size[1] * grid.size[2]);
  Samples samples{grid, std::move(grid)};
  const auto& size = samples.lumen.size;
  const double longest = 1 * geometry::mm;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0];) {
        const auto v = model.at(samples.lumen.place(i, j, k), beyond);
        const double free = std::min({std::abs(v.lumen), std::abs(v.outer), longest}) - 2 * spacing;
        const auto end =
            std::min(size[0], i + 1 + std::max<std::int64_t>(0, static_cast<std::int64_t>(free / spacing)));
        for (; i < end; ++i) {
          samples.lumen.values[samples.lumen.index(i, j, k)] = static_cast<float>(v.lumen);
          samples.outer.values[samples.outer.index(i, j, k)] = static_cast<float>(v.outer);
        }
      }
  return samples;
}

/// One function of the model with its gradient.
class Field {
 public:
  Field(const geometry::DissectionModel& model, double beyond, Function function)
      : model_(model), beyond_(beyond), function_(function) {}
  double operator()(const geometry::Point& p) const { return model_.at(p, beyond_).*function_; }
  Vec3<double> gradient(const geometry::Point& p) const {
    constexpr double step = 1e-6;
    Vec3<double> result{{0, 0, 0}};
    for (int d = 0; d < 3; ++d) {
      geometry::Point ahead = p, behind = p;
      ahead[d] += step;
      behind[d] -= step;
      result[d] = ((*this)(ahead) - (*this)(behind)) / (2 * step);
    }
    return result;
  }

 private:
  const geometry::DissectionModel& model_;
  double beyond_;
  Function function_;
};

/// Moves points of the contour, which is linear between samples, onto the surface: Newton's method along the gradient.
/// At the ends beyond the cuts the function jumps; points stay there.
void move_onto(const Field& field, double reach, geometry::TriangleSurface& surface) {
  for (auto& p : surface.points)
    for (int iteration = 0; iteration < 3; ++iteration) {
      const double value = field(p);
      if (std::abs(value) < 1e-7) break;
      const auto gradient = field.gradient(p);
      const auto move = (value / std::max(0.1, dot(gradient, gradient))) * gradient;
      if (!(norm(move) < reach)) break;
      p = p - move;
    }
}

/// Flat triangles with corners on a curved surface cut its volume. Moves the points off it by the mean distance of
/// their triangles, which is that of the middles of their edges.
void keep_volume(const Field& field, double reach, geometry::TriangleSurface& surface) {
  std::vector<double> gaps(surface.triangles.size(), 0.0);
  for (const auto& edge : geometry::edges(surface)) {
    const double value = field(0.5 * (surface.points[edge.a] + surface.points[edge.b]));
    if (!(std::abs(value) < reach)) continue;
    for (const auto t : edge.triangles) gaps[t] -= value / 3;
  }
  std::vector<Vec3<double>> normals(surface.points.size(), {{0, 0, 0}});
  std::vector<double> volumes(surface.points.size(), 0.0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto area = geometry::area_vector(surface, surface.triangles[t]);
    for (const auto p : surface.triangles[t]) {
      normals[p] = normals[p] + area;
      volumes[p] += norm(area) * gaps[t];
    }
  }
  for (std::size_t p = 0; p < surface.points.size(); ++p)
    if (const double square = dot(normals[p], normals[p]); square > 0)
      surface.points[p] = surface.points[p] + (volumes[p] / square) * normals[p];
}

/// Edge length at each point [m]: the surface turns by about 25 degrees over an edge, at most. Normals are those of the
/// field, since a contour is full of slivers, from which no curvature can be told.
std::vector<double> sizes_by_curvature(const Field& field, const geometry::TriangleSurface& surface, double smallest,
                                       double largest) {
  std::vector<Vec3<double>> normals;
  for (const auto& p : surface.points) {
    const auto gradient = field.gradient(p);
    normals.push_back((1 / norm(gradient)) * gradient);
  }
  std::vector<double> sizes(surface.points.size(), largest);
  for (const auto& edge : geometry::edges(surface)) {
    const double length = norm(surface.points[edge.b] - surface.points[edge.a]);
    const double turn = norm(normals[edge.b] - normals[edge.a]);
    if (length < 0.1 * smallest || turn == 0) continue;
    for (const auto p : {edge.a, edge.b}) sizes[p] = std::min(sizes[p], std::max(smallest, 0.45 * length / turn));
  }
  geometry::limit_gradation(surface, 0.3, sizes);
  return sizes;
}

geometry::TriangleSurface make_surface(const geometry::DissectionModel& model, const geometry::Grid& grid,
                                       double beyond, Function function) {
  const double spacing = grid.spacing;
  const Field field(model, beyond, function);
  auto surface = geometry::zero_surface(grid);
  move_onto(field, spacing, surface);
  keep_volume(field, 0.2 * spacing, surface);
  for (const auto& o : model.openings())
    surface = geometry::cut_end(surface, {o.centre, o.normal, o.outer_radius + beyond});
  auto sizes = sizes_by_curvature(field, surface, 0.4 * spacing, 2 * spacing);
  return geometry::remesh({surface, {}}, {geometry::TriangleTree(surface), {}, std::move(sizes)}, {.sweeps = 5})
      .surface;
}

}  // namespace

PatientSurfaces dissection_surfaces(const geometry::DissectionModel& model, double spacing) {
  const double beyond = 3 * spacing;
  const auto samples = sample(model, beyond, spacing);
  PatientSurfaces surfaces{make_surface(model, samples.lumen, beyond, &geometry::DissectionModel::Values::lumen),
                           make_surface(model, samples.outer, beyond, &geometry::DissectionModel::Values::outer),
                           {}};
  for (const auto& o : model.openings()) surfaces.names.push_back({o.name, o.centre});
  return surfaces;
}

}  // namespace tunica::meshing
