#include "tunica/coupling/moved_faces.hpp"

#include <algorithm>
#include <map>

#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

/// Displacement of a node along an axis, as numbers that a halo update carries.
struct Mark {
  double face = 0;      ///< number of the condition that moves it, from 1; 0: none, -1: held at rest
  double per_unit = 0;  ///< m
};

/// Marks of all nodes, [local node][axis].
class Marks {
 public:
  explicit Marks(const distributed::DistributedMesh& mesh)
      : mesh_(mesh), values_(6 * static_cast<std::size_t>(mesh.nodes()), 0.0) {}

  void put(const std::string& face_name, std::size_t axis, const Mark& mark) {
    const auto& face = mesh_.face(face_name);
    const auto put_at = [&](std::int32_t node) {
      double* value = values_.data() + 6 * static_cast<std::size_t>(mesh_.host[node]) + 2 * axis;
      value[0] = mark.face;
      value[1] = mark.per_unit;
    };
    for (const auto& triangle : face.triangles) std::for_each(triangle.begin(), triangle.end(), put_at);
    for (const auto& edges : face.edges) std::for_each(edges.begin(), edges.end(), put_at);
  }
  /// Ghosts may lie outside of every triangle that this rank sees, so their owners tell them.
  void complete() { mesh_.halo.update(values_, 6); }
  Mark at(std::int32_t node, int axis) const {
    const double* value = values_.data() + 6 * static_cast<std::size_t>(node) + 2 * static_cast<std::size_t>(axis);
    return {value[0], value[1]};
  }

 private:
  const distributed::DistributedMesh& mesh_;
  std::vector<double> values_;
};

}  // namespace

MovedFaces::MovedFaces(const distributed::DistributedMesh& mesh,
                       std::span<const std::pair<std::string, bc::Condition>> conditions) {
  std::map<std::string, double> number;
  for (const auto& [name, condition] : conditions)
    if (const auto* moved = std::get_if<bc::Displacement>(&condition)) {
      courses_.push_back(parallel::agree(mesh.comm, [&] {
        FaceCourse course{bc::make_waveform(moved->course), {}};
        if (moved->over_face) course.table.emplace(*moved->over_face, bc::displacement_columns);
        return course;
      }));
      number.emplace(name, static_cast<double>(courses_.size()));
    }
  if (courses_.empty()) return;
  Marks marks(mesh);
  for (const bool moving : {true, false})  // what is at rest counts, so it comes last
    for (const auto& [name, condition] : conditions) {
      const auto* moved = std::get_if<bc::Displacement>(&condition);
      for (std::size_t axis = 0; axis < 3 && moving == (moved != nullptr); ++axis)
        if (bc::held_axes(condition)[axis])
          marks.put(name, axis, moved ? Mark{number.at(name), moved->value[static_cast<int>(axis)]} : Mark{.face = -1});
    }
  marks.complete();
  for (std::int32_t node = 0; node < mesh.nodes(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      if (const Mark mark = marks.at(node, axis); mark.face > 0)
        motions_.push_back({node, axis, mark.per_unit, static_cast<std::size_t>(mark.face) - 1});
  parallel::agree(mesh.comm, [&] { look_up_histories(mesh); });
}

void MovedFaces::look_up_histories(const distributed::DistributedMesh& mesh) {
  std::map<std::pair<std::int32_t, std::size_t>, std::int32_t> found;
  for (auto& motion : motions_) {
    const auto& table = courses_[motion.course].table;
    if (!table) continue;
    const auto [at, is_new] =
        found.emplace(std::pair(motion.node, motion.course), static_cast<std::int32_t>(histories_.size()));
    if (is_new) histories_.push_back(table->history(mesh.points[motion.node]));
    motion.history = at->second;
  }
}

void MovedFaces::at(double t, const std::function<void(std::int32_t, int, double)>& visit) const {
  std::vector<double> values;
  values.reserve(courses_.size());
  for (const auto& course : courses_) values.push_back(course.course.value(t));
  for (const auto& motion : motions_) {
    const double per_unit = motion.history < 0
                                ? motion.per_unit
                                : courses_[motion.course].table->value(
                                      histories_[static_cast<std::size_t>(motion.history)], t)[motion.axis];
    visit(motion.node, motion.axis, values[motion.course] * per_unit);
  }
}

}  // namespace tunica::coupling
