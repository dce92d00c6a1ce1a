// Where a run stands on its grid of equal steps, and how large the next step is.
#pragma once

#include <cstdint>

namespace tunica::artifacts {

/// Steps of one nominal size, of which a rejected one is taken in parts: halves, quarters, and so on. Parts grow again
/// as soon as they fill a larger one, so every multiple of the nominal size is reached exactly.
class StepGrid {
 public:
  /// What a checkpoint keeps. Positions count in units of the nominal size / 2^finest.
  struct Position {
    double base_time = 0.0;  ///< time of the grid's step `base_step` [s]
    std::int64_t base_step = 0;
    double nominal = 0.0;   ///< size of a step [s]
    std::int64_t done = 0;  ///< completed nominal steps
    std::int64_t part = 0;  ///< what is done of the next one
    int level = 0;          ///< the next step is nominal / 2^level
  };
  static constexpr int finest = 30;

  /// A grid from time 0. `nominal` > 0; at most `max_halvings` <= finest halvings.
  StepGrid(double nominal, int max_halvings);
  /// Goes on from `position`. Where the nominal size has changed, a new grid begins at the time of `position`.
  StepGrid(double nominal, int max_halvings, const Position& position);

  const Position& position() const { return position_; }
  std::int64_t steps_done() const { return position_.done; }
  /// Is the time a multiple of the nominal size?
  bool on_grid() const { return position_.part == 0; }
  int level() const { return position_.level; }
  double time() const;
  /// Size of the next step.
  double next_step() const { return position_.nominal / static_cast<double>(std::int64_t{1} << position_.level); }

  /// The next step was accepted. `wanted`: level that the following steps shall come to, at once where it is finer, and
  /// where it is coarser as soon as parts fill a larger one.
  void accept(int wanted = 0);
  /// The next step was rejected and is halved; false when it may not be.
  bool halve();

 private:
  int max_halvings_;
  Position position_;
};

}  // namespace tunica::artifacts
