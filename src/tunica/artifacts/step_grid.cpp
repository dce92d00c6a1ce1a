#include "tunica/artifacts/step_grid.hpp"

#include <algorithm>
#include <cassert>

namespace tunica::artifacts {

namespace {
constexpr std::int64_t whole = std::int64_t{1} << StepGrid::finest;
}

StepGrid::StepGrid(double nominal, int max_halvings) : max_halvings_(max_halvings) {
  assert(nominal > 0 && max_halvings >= 0 && max_halvings <= finest);
  position_.nominal = nominal;
}

StepGrid::StepGrid(double nominal, int max_halvings, const Position& position)
    : max_halvings_(max_halvings), position_(position) {
  if (nominal == position.nominal) return;
  position_.base_time = time();
  position_.base_step = position.done;
  position_.nominal = nominal;
  position_.part = 0;
  position_.level = 0;
}

double StepGrid::time() const {
  const double fraction = static_cast<double>(position_.part) / static_cast<double>(whole);
  return position_.base_time +
         position_.nominal * (static_cast<double>(position_.done - position_.base_step) + fraction);
}

void StepGrid::accept(int wanted) {
  position_.part += whole >> position_.level;
  // A larger part may begin wherever one could have begun had nothing been rejected.
  if (position_.level > wanted && position_.part % (whole >> (position_.level - 1)) == 0) --position_.level;
  position_.level = std::max(position_.level, std::min(wanted, max_halvings_));
  if (position_.part < whole) return;
  position_.part = 0;
  ++position_.done;
}

bool StepGrid::halve() {
  if (position_.level >= max_halvings_) return false;
  ++position_.level;
  return true;
}

}  // namespace tunica::artifacts
