#include "tunica/meshing/tetrahedralise.hpp"

#include <fmt/format.h>
#define TETLIBRARY
#include <tetgen.h>

#include <cmath>
#include <map>

#include "tunica/base/error.hpp"

namespace tunica::meshing {

namespace {

constexpr double to_tetgen = 1e3;  // its tolerances are made for numbers near one: millimetres

static_assert(static_cast<int>(Label::lumen) == geometry::lumen_label &&
              static_cast<int>(Label::wall) == geometry::wall_label);

bool bounds(const Patch& patch, Label label) { return patch.negative == label || patch.positive == label; }

/// TetGen frees what hangs from the facets with delete[].
void add_facet(tetgenio::facet& facet, const std::array<int, 3>& corners) {
  tetgenio::init(&facet);
  facet.numberofpolygons = 1;
  facet.polygonlist = new tetgenio::polygon[1];
  tetgenio::polygon& polygon = facet.polygonlist[0];
  polygon.numberofvertices = 3;
  polygon.vertexlist = new int[3];
  std::copy(corners.begin(), corners.end(), polygon.vertexlist);
}

/// Places in the cavities of a label: what its surfaces enclose but is not its own, such as a false lumen that no tear
/// joins to the true one, within the wall. Of a cavity the surface has a negative volume.
std::vector<geometry::Point> places_in_cavities(const SurfaceComplex& complex, Label label) {
  geometry::TriangleSurface around{complex.points, {}};
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    const Patch& patch = complex.patches[complex.patch_of[t]];
    if (!bounds(patch, label)) continue;
    auto corners = complex.triangles[t];
    if (patch.positive == label) std::swap(corners[1], corners[2]);
    around.triangles.push_back(corners);
  }
  const auto part = geometry::components(around);
  std::map<std::int64_t, std::vector<geometry::Triangle>> parts;
  for (std::size_t t = 0; t < part.size(); ++t) parts[part[t]].push_back(around.triangles[t]);
  std::vector<geometry::Point> places;
  for (const auto& [number, triangles] : parts) {
    const geometry::TriangleSurface surface{complex.points, triangles};
    if (geometry::enclosed_volume(surface) >= 0) continue;
    constexpr double into = 1e-3;  // of the size of a triangle: nothing else is that near
    const auto& t = triangles.front();
    const auto area = geometry::area_vector(surface, t);
    const auto middle = (1.0 / 3) * (complex.points[t[0]] + complex.points[t[1]] + complex.points[t[2]]);
    places.push_back(middle + (into / std::sqrt(norm(area))) * area);
  }
  return places;
}

void leave_out(tetgenio& in, const std::vector<geometry::Point>& places) {
  in.numberofholes = static_cast<int>(places.size());
  if (places.empty()) return;
  in.holelist = new double[3 * places.size()];
  for (std::size_t h = 0; h < places.size(); ++h)
    for (int d = 0; d < 3; ++d) in.holelist[3 * h + d] = to_tetgen * places[h][d];
}

/// The part of the complex around one label, and the number of each of its points in the complex.
struct Hull {
  tetgenio input;
  std::vector<std::int64_t> points;
};

void fill_in(Hull& hull, const SurfaceComplex& complex, Label label, const std::vector<double>& sizes) {
  std::vector<int> number(complex.points.size(), -1);
  std::vector<std::array<int, 3>> facets;
  std::vector<int> markers;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    if (!bounds(complex.patches[complex.patch_of[t]], label)) continue;
    auto& facet = facets.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto p = complex.triangles[t][k];
      if (number[p] < 0) {
        number[p] = static_cast<int>(hull.points.size());
        hull.points.push_back(p);
      }
      facet[k] = number[p];
    }
    markers.push_back(complex.patch_of[t] + 1);
  }
  tetgenio& in = hull.input;
  in.numberofpoints = static_cast<int>(hull.points.size());
  in.pointlist = new double[3 * hull.points.size()];
  in.numberofpointmtrs = 1;
  in.pointmtrlist = new double[hull.points.size()];
  for (std::size_t i = 0; i < hull.points.size(); ++i) {
    for (int d = 0; d < 3; ++d) in.pointlist[3 * i + d] = to_tetgen * complex.points[hull.points[i]][d];
    in.pointmtrlist[i] = to_tetgen * sizes[hull.points[i]];
  }
  in.numberoffacets = static_cast<int>(facets.size());
  in.facetlist = new tetgenio::facet[facets.size()];
  in.facetmarkerlist = new int[facets.size()];
  for (std::size_t f = 0; f < facets.size(); ++f) {
    add_facet(in.facetlist[f], facets[f]);
    in.facetmarkerlist[f] = markers[f];
  }
  leave_out(in, places_in_cavities(complex, label));
}

const char* reason(int code) {
  switch (code) {
    case 1:
      return "out of memory";
    case 3:
      return "two of the given triangles cross";
    case 4:
      return "a given edge or angle is too small";
    case 5:
      return "two given triangles lie nearly on each other";
    default:
      return "an internal error";
  }
}

/// Adds the tetrahedra inside the hull of a label to `mesh`, whose first points are those of the complex. `sizes`: edge
/// length inside [m], at each of these.
void fill(const SurfaceComplex& complex, Label label, const std::vector<double>& sizes, geometry::Tetrahedra& mesh) {
  Hull hull;
  fill_in(hull, complex, label, sizes);
  tetgenio output;
  // p: a closed complex; Y: its triangles stay whole; A: no merging; q: ratio and angle; m: sizes; Q: silent.
  char switches[] = "pYQq1.4/10m";
  const char* name = label == Label::lumen ? "lumen" : "wall";
  try {
    tetrahedralize(switches, &hull.input, &output);
  } catch (int code) {
    throw SolverError(fmt::format("meshing: TetGen cannot fill the {}: {}; try another size", name, reason(code)));
  }
  if (output.numberoftetrahedra == 0)
    throw SolverError(fmt::format("meshing: TetGen put nothing into the {}: its surfaces are not closed", name));

  std::vector<geometry::Index> number(hull.points.begin(), hull.points.end());
  for (int p = output.firstnumber + std::ssize(hull.points); p < output.numberofpoints; ++p) {
    number.push_back(std::ssize(mesh.points));
    const double* x = output.pointlist + 3 * static_cast<std::ptrdiff_t>(p);
    mesh.points.push_back({{x[0] / to_tetgen, x[1] / to_tetgen, x[2] / to_tetgen}});
  }
  for (int e = 0; e < output.numberoftetrahedra; ++e) {
    const int* corners = output.tetrahedronlist + output.numberofcorners * static_cast<std::ptrdiff_t>(e);
    auto& element = mesh.elements.emplace_back();
    for (int k = 0; k < 4; ++k) element[k] = number[corners[k]];
    const geometry::Point &a = mesh.points[element[0]], &b = mesh.points[element[1]], &c = mesh.points[element[2]];
    if (dot(cross(b - a, c - a), mesh.points[element[3]] - a) < 0) std::swap(element[2], element[3]);
    mesh.labels.push_back(static_cast<int>(label));
  }
}

/// Points where patches meet.
std::vector<bool> on_rims(const SurfaceComplex& complex) {
  std::vector<bool> result(complex.points.size(), false);
  std::vector<std::int32_t> first(complex.points.size(), -1);
  for (std::size_t t = 0; t < complex.triangles.size(); ++t)
    for (const auto p : complex.triangles[t]) {
      if (first[p] >= 0 && first[p] != complex.patch_of[t]) result[p] = true;
      first[p] = complex.patch_of[t];
    }
  return result;
}

}  // namespace

geometry::Tetrahedra tetrahedralise(const SurfaceComplex& complex,
                                    const std::function<double(const geometry::Point&)>& size,
                                    const FillSettings& settings) {
  std::vector<double> in_lumen, in_wall;
  for (const auto& p : complex.points) {
    const double at_surface = size(p);
    // Never finer than the triangles around it, which stay.
    in_lumen.push_back(settings.lumen_size ? std::max(at_surface, settings.lumen_size(p))
                                           : settings.in_lumen * at_surface);
    in_wall.push_back(settings.in_wall * at_surface);
  }
  geometry::Tetrahedra mesh;
  mesh.points = complex.points;
  mesh.on_curve = on_rims(complex);
  fill(complex, Label::lumen, in_lumen, mesh);
  const auto has_wall = [](const Patch& patch) { return bounds(patch, Label::wall); };
  if (std::any_of(complex.patches.begin(), complex.patches.end(), has_wall)) fill(complex, Label::wall, in_wall, mesh);
  mesh.on_curve.resize(mesh.points.size(), false);
  return mesh;
}

}  // namespace tunica::meshing
