#include "benchmark/laws/point_loops.inl.hpp"

namespace tunica::benchmarks {
template PointLoops make_point_loops<2>();
}
