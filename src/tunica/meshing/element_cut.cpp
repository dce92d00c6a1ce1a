#include "tunica/meshing/element_cut.hpp"

namespace tunica::meshing {

std::vector<geometry::Point> zero_polygon(const std::array<geometry::Point, 4>& corners,
                                          const std::array<double, 4>& values) {
  int positive[4], negative[4], positives = 0, negatives = 0;
  for (int k = 0; k < 4; ++k) (values[k] > 0 ? positive[positives++] : negative[negatives++]) = k;
  std::vector<geometry::Point> polygon;
  // To and fro, so that neighbours in the list lie on a common face and the corners go round.
  for (int i = 0; i < positives; ++i)
    for (int j = 0; j < negatives; ++j) {
      const int a = positive[i], b = negative[i % 2 == 0 ? j : negatives - 1 - j];
      polygon.push_back(corners[a] + (values[a] / (values[a] - values[b])) * (corners[b] - corners[a]));
    }
  return polygon;
}

}  // namespace tunica::meshing
