#include "tunica/meshing/tears.hpp"

#include <algorithm>

#include "tunica/meshing/element_cut.hpp"

namespace tunica::meshing {

namespace {

/// The piece of the zero surface within one element: area vector towards positive values, and its middle.
struct Piece {
  Vec3<double> area{{0, 0, 0}};
  geometry::Point middle{{0, 0, 0}};
};

Piece piece_of(const geometry::Tetrahedra& mesh, const std::vector<double>& side,
               const std::array<geometry::Index, 4>& element) {
  std::array<geometry::Point, 4> x;
  std::array<double, 4> values;
  for (int k = 0; k < 4; ++k) {
    x[k] = mesh.points[element[k]];
    values[k] = side[element[k]];
  }
  const auto corners = zero_polygon(x, values);
  Piece piece;
  for (const auto& c : corners) piece.middle = piece.middle + (1.0 / static_cast<double>(corners.size())) * c;
  for (std::size_t k = 2; k < corners.size(); ++k)
    piece.area = piece.area + 0.5 * cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  const auto above = std::find_if(element.begin(), element.end(), [&](geometry::Index n) { return side[n] > 0; });
  if (dot(piece.area, mesh.points[*above] - piece.middle) < 0) piece.area = -1.0 * piece.area;
  return piece;
}

bool changes_sign(const std::vector<double>& side, const std::array<geometry::Index, 4>& element) {
  const auto positive = std::count_if(element.begin(), element.end(), [&](geometry::Index n) { return side[n] > 0; });
  return positive > 0 && positive < 4;
}

}  // namespace

std::vector<Tear> find_tears(const geometry::Tetrahedra& mesh, const std::vector<double>& side) {
  const auto adjacent = geometry::neighbours(mesh);
  std::vector<bool> open(mesh.elements.size(), false);
  for (std::size_t e = 0; e < open.size(); ++e)
    open[e] = mesh.labels[e] == geometry::lumen_label && changes_sign(side, mesh.elements[e]);
  std::vector<Tear> tears;
  for (geometry::Index start = 0; start < std::ssize(open); ++start) {
    if (!open[start]) continue;
    std::vector<geometry::Index> stack = {start};
    open[start] = false;
    Tear tear{{{0, 0, 0}}, {{0, 0, 0}}, 0, {}};
    double weight = 0;  // of the centre
    while (!stack.empty()) {
      const geometry::Index e = stack.back();
      stack.pop_back();
      tear.elements.push_back(e);
      const auto piece = piece_of(mesh, side, mesh.elements[e]);
      const double area = norm(piece.area);
      tear.centre = tear.centre + area * piece.middle;
      tear.normal = tear.normal + piece.area;
      weight += area;
      for (const auto other : adjacent[e])
        if (other >= 0 && open[other]) {
          open[other] = false;
          stack.push_back(other);
        }
    }
    if (weight == 0) continue;
    tear.centre = (1 / weight) * tear.centre;
    // The area vector depends on the rim alone, whichever way the surface bulges or zigzags within it.
    tear.area = norm(tear.normal);
    if (tear.area > 0) tear.normal = (1 / tear.area) * tear.normal;
    tears.push_back(tear);
  }
  std::sort(tears.begin(), tears.end(), [](const Tear& a, const Tear& b) { return a.area > b.area; });
  return tears;
}

}  // namespace tunica::meshing
