#include "tunica/coupling/moved_faces.hpp"

#include <map>

#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

/// Displacement of a node along an axis, as numbers that a halo update carries: which face moves it, how far.
struct Mark {
  double face = 0;  ///< number of the condition, from 1; 0: none, -1: held at rest
  double per_unit = 0;
};

}  // namespace

// Ghosts may lie outside of every triangle that this rank sees, so their owners tell them.
MovedFaces::MovedFaces(const distributed::DistributedMesh& mesh,
                       std::span<const std::pair<std::string, bc::Condition>> conditions) {
  std::vector<double> marks;  // [local node][axis]: Mark
  const auto mark_face = [&](const std::string& name, std::size_t axis, const Mark& mark) {
    const auto set = [&](std::int32_t node) {
      double* m = marks.data() + 6 * static_cast<std::size_t>(mesh.host[node]) + 2 * axis;
      m[0] = mark.face;
      m[1] = mark.per_unit;
    };
    for (const auto* cells : {&mesh.face(name).triangles})
      for (const auto& cell : *cells)
        for (const auto node : cell) set(node);
    for (const auto& edges : mesh.face(name).edges)
      for (const auto node : edges) set(node);
  };
  const auto mark_all = [&](auto kind) {
    for (const auto& [name, condition] : conditions)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (bc::held_axes(condition)[axis]) kind(name, axis, condition);
  };
  for (const auto& [name, condition] : conditions)
    if (const auto* moved = std::get_if<bc::Displacement>(&condition))
      courses_.push_back(parallel::agree(mesh.comm, [&] { return bc::make_waveform(moved->course); }));
  if (courses_.empty()) return;
  marks.assign(6 * static_cast<std::size_t>(mesh.nodes()), 0.0);
  std::map<std::string, std::size_t> number;
  for (const auto& [name, condition] : conditions)
    if (std::holds_alternative<bc::Displacement>(condition)) number.emplace(name, number.size() + 1);
  mark_all([&](const std::string& name, std::size_t axis, const bc::Condition& condition) {
    if (const auto* moved = std::get_if<bc::Displacement>(&condition))
      mark_face(name, axis, {static_cast<double>(number.at(name)), moved->value[static_cast<int>(axis)]});
  });
  mark_all([&](const std::string& name, std::size_t axis, const bc::Condition& condition) {
    if (!std::holds_alternative<bc::Displacement>(condition)) mark_face(name, axis, {-1.0, 0.0});
  });
  mesh.halo.update(marks, 6);
  for (std::int32_t node = 0; node < mesh.nodes(); ++node)
    for (int axis = 0; axis < 3; ++axis) {
      const double* m = marks.data() + 6 * static_cast<std::size_t>(node) + 2 * static_cast<std::size_t>(axis);
      if (m[0] > 0) motions_.push_back({node, axis, m[1], static_cast<std::size_t>(m[0]) - 1});
    }
}

void MovedFaces::at(double t, const std::function<void(std::int32_t, int, double)>& visit) const {
  std::vector<double> values;
  values.reserve(courses_.size());
  for (const auto& course : courses_) values.push_back(course.value(t));
  for (const auto& motion : motions_) visit(motion.node, motion.axis, values[motion.course] * motion.per_unit);
}

}  // namespace tunica::coupling
