#include "tunica/coupling/boundaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/bc/velocity_profile.hpp"
#include "tunica/coupling/face_plane.hpp"
#include "tunica/coupling/held_nodes.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/coupling/whole_face.hpp"
#include "tunica/fluid/boundary.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

constexpr bc::Axes every_axis{true, true, true};

/// Flow out of the lumen relative to the moving mesh, of the triangles that this rank owns [m^3/s].
double owned_flow(const distributed::DistributedMesh& mesh, const distributed::Face& face, const FieldsView& fields) {
  double sum = 0;
  for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
    Vec3<double> x[3], v[3], w[3];
    // Of linear functions the corners have a third of the area each, of quadratic ones the nodes of the edges.
    const auto& nodes = mesh.quadratic ? face.edges[t] : face.triangles[t];
    gather(fields.position, face.triangles[t], x);
    gather(fields.velocity_pressure, nodes, v);
    gather(fields.mesh_velocity, nodes, w);
    sum += fluid::flow(x, v, w);
  }
  return sum;
}

void check_inflows(const BoundaryInput& input) {
  std::set<std::string> flows;
  std::string names;
  for (const auto& [face, condition] : input.conditions)
    if (std::holds_alternative<bc::Flow>(condition)) {
      flows.insert(face);
      names += (names.empty() ? "" : ", ") + face;
    }
  for (const auto& [face, course] : input.inflows)
    if (!flows.contains(face))
      throw InputError("inflow of " + face, "the case gives no condition `flow` to a face of this name",
                       flows.empty() ? "add `" + face + ": {flow: 0 ml/s}` to `boundary`: it stands for the function"
                                     : "name one of: " + names);
}

}  // namespace

// Collects what the conditions ask of nodes, face by face.
struct Boundaries::Builder {
  Boundaries& b;
  const distributed::DistributedMesh& mesh;
  std::vector<Held> held, mesh_held, symmetric;  // `symmetric`: by planes of symmetry alone
  std::vector<std::size_t> symmetry_faces{}, partly_free{};
  std::vector<char> interface_node;
  const std::vector<std::pair<std::string, Course>>& inflows;

  Builder(Boundaries& boundaries, const BoundaryInput& input)
      : b(boundaries),
        mesh(b.mesh_),
        held(mesh.nodes()),
        mesh_held(mesh.nodes()),
        symmetric(mesh.nodes()),
        interface_node(mesh.nodes(), 0),
        inflows(input.inflows) {
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)
      if (mesh.host[i] != i) {
        held[i].all();  // the host moves for it
        interface_node[mesh.host[i]] = 1;
        mesh_held[mesh.host[i]].all();
      }
  }

  bc::Waveform waveform(const bc::WaveformInput& input) const {
    return parallel::agree(mesh.comm, [&] { return bc::make_waveform(input); });
  }

  /// None where there is no table.
  std::optional<NodalHistories> histories(std::size_t face, const std::optional<bc::OverFace>& source,
                                          const bc::PointColumns& columns) const {
    if (!source) return std::nullopt;
    return parallel::agree(mesh.comm, [&] {
      return std::optional<NodalHistories>(NodalHistories(mesh, mesh.faces[face], bc::PointTable(*source, columns)));
    });
  }

  template <class Visit>
  void for_each_node(const distributed::Face& face, Visit visit) const {
    for (const auto& triangle : face.triangles)
      for (const auto node : triangle) visit(node);
    for (const auto& edges : face.edges)
      for (const auto node : edges) visit(node);
  }

  void hold(std::int32_t node, const bc::Axes& axes) {
    if (axes == every_axis) return held[node].all();
    for (int i = 0; i < 3; ++i)
      if (axes[static_cast<std::size_t>(i)])
        held[node].direction({{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0}});
  }
  // In FSI the rim of an opening belongs to the wall; nodes that no_slip holds stay at rest.
  template <class Visit>
  void hold_inner(const distributed::Face& face, const bc::Axes& axes, Visit visit_owned) {
    std::vector<char> done(mesh.nodes(), 0);
    for_each_node(face, [&](std::int32_t node) {
      if (interface_node[node] || done[node]) return;
      done[node] = 1;
      hold(node, axes);
      if (node < mesh.owned_nodes) visit_owned(node);
    });
  }
  // Where the velocity is free along some axes the blood may turn back, as at an outlet without pressure.
  void leave_open(std::size_t index, const bc::Axes& axes) {
    if (axes == every_axis) return;
    b.loads_.bind_open(index);
    partly_free.push_back(index);
  }
  static Course course_of(bc::Waveform waveform) {
    return [waveform = std::move(waveform)](double t) { return waveform.value(t); };
  }
  void prescribe(const distributed::Face& face, const bc::Axes& axes, Course course,
                 const std::function<Vec3<double>(std::int32_t)>& velocity) {
    const std::size_t number = b.courses_.size();
    b.courses_.push_back(std::move(course));
    hold_inner(face, axes, [&](std::int32_t node) { b.prescribed_.push_back({node, velocity(node), number, axes}); });
  }
  void prescribe(const distributed::Face& face, const bc::Axes& axes, const VectorField& velocity) {
    const std::size_t field = b.velocity_fields_.size();
    b.velocity_fields_.push_back(velocity);
    hold_inner(face, axes, [&](std::int32_t node) {
      b.field_nodes_.push_back({node, field, identity<double>(), axes});
    });
  }

  // What an opening prescribes does not cross a plane of symmetry that it meets.
  void project_on_symmetry() {
    parallel::agree(mesh.comm, [&] {
      for (const auto index : partly_free) require_aligned(mesh.faces[index]);
    });
    for (auto& p : b.prescribed_) p.velocity = symmetric[p.node].P * p.velocity;
    for (auto& p : b.field_nodes_) p.allowed = symmetric[p.node].P;
  }

  bc::SymmetryMarks symmetry_marks(const WholeFace& whole) const {
    bc::SymmetryMarks marks;
    for (const auto f : symmetry_faces) {
      std::vector<double> on(whole.points.size(), 0.0);
      for_each_node(mesh.faces[f], [&](std::int32_t node) {
        if (const auto k = whole.find(mesh.global_ids[node]); k >= 0) on[static_cast<std::size_t>(k)] = 1.0;
      });
      parallel::global_sum(mesh.comm, on);
      marks.emplace_back(on.size());
      std::transform(on.begin(), on.end(), marks.back().begin(), [](double n) { return n > 0 ? 1 : 0; });
    }
    return marks;
  }

  // Of several nearest nodes the one with the lowest original number, on any number of ranks.
  void hold_pressure(const PressurePoint& held_point) {
    const Vec3<double>& point = held_point.place;
    double nearest = std::numeric_limits<double>::max();
    std::vector<std::int32_t> nodes;
    for (const auto& region : mesh.regions)
      if (region.kind == mesh::RegionKind::lumen)
        for (const auto& element : region.elements)
          for (const auto node : element)
            if (node < mesh.owned_nodes) nodes.push_back(node);
    for (const auto node : nodes) nearest = std::min(nearest, norm(mesh.points[node] - point));
    nearest = parallel::global_min(mesh.comm, nearest);
    std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
    for (const auto node : nodes)
      if (norm(mesh.points[node] - point) <= nearest) lowest = std::min(lowest, mesh.original_ids[node]);
    lowest = parallel::global_min(mesh.comm, lowest);
    for (const auto node : nodes)
      if (mesh.original_ids[node] == lowest) {
        held[node].pressure = true;
        b.pressure_node_ = node;
      }
    b.held_pressure_ = held_point.pressure;
  }

  void operator()(std::size_t index, const bc::NoSlip&) {
    for_each_node(mesh.faces[index], [&](std::int32_t node) { held[node].all(); });
  }
  void operator()(std::size_t index, const bc::Velocity& c) {
    prescribe(mesh.faces[index], c.directions, course_of(waveform(c.course)), [&](std::int32_t) { return c.value; });
    leave_open(index, c.directions);
  }
  void operator()(std::size_t index, const bc::Flow& c) {
    const WholeFace whole = gather_face(mesh, mesh.faces[index]);
    const auto marks = symmetry_marks(whole);
    const auto profile = parallel::agree(mesh.comm, [&] { return bc::inflow_profile(whole.mesh(), c.profile, marks); });
    const auto own = std::find_if(inflows.begin(), inflows.end(),
                                  [&](const auto& inflow) { return inflow.first == mesh.faces[index].name; });
    Course flow =
        own != inflows.end() ? own->second : course_of(parallel::agree(mesh.comm, [&] { return bc::inflow(c); }));
    parallel::agree(mesh.comm, [&] { require_upright(mesh.faces[index], profile.normal); });
    b.inflows_.push_back({index, b.courses_.size()});
    prescribe(mesh.faces[index], every_axis, std::move(flow), [&](std::int32_t node) {
      return profile.velocity(static_cast<std::size_t>(whole.find(mesh.global_ids[node])), 1.0);
    });
  }
  void operator()(std::size_t index, const bc::Pressure& c) {
    SurfaceLoad load{.face = index, .kind = SurfaceLoad::Kind::lumen_pressure};
    if (is_wall(index))
      load.kind = c.follower ? SurfaceLoad::Kind::follower_pressure : SurfaceLoad::Kind::dead_pressure;
    load.course = waveform(c.pressure);
    load.over_face = histories(index, c.over_face, bc::factor_column);
    b.loads_.bind(load);
    hold_along(index, c.fixed);
  }
  void operator()(std::size_t index, const bc::Traction& c) {
    SurfaceLoad load{.face = index,
                     .kind = is_wall(index) ? SurfaceLoad::Kind::dead_traction : SurfaceLoad::Kind::lumen_traction};
    load.vector = c.vector;
    load.course = waveform(c.course);
    load.over_face = histories(index, c.over_face, bc::traction_columns);
    b.loads_.bind(load);
    hold_along(index, c.fixed);
  }
  void operator()(std::size_t index, const bc::Displacement& c) { hold_along(index, c.directions); }
  void operator()(std::size_t index, const bc::Resistance& c) { outlet(index, c); }
  void operator()(std::size_t index, const bc::Rcr& c) { outlet(index, c); }
  void outlet(std::size_t index, const std::variant<bc::Resistance, bc::Rcr>& model) {
    b.outlets_.push_back({index, model});
    b.loads_.bind_open(index);
  }
  void operator()(std::size_t index, const bc::Fixed& c) {
    hold_along(index, c.axes());
    if (!c.along_normal()) return;
    const auto& face = mesh.faces[index];
    const Vec3<double> normal = mean_normal(mesh, face);
    for_each_node(face, [&](std::int32_t wall_node) { held[mesh.host[wall_node]].direction(normal); });
  }
  void hold_along(std::size_t index, const bc::Axes& axes) {
    for_each_node(mesh.faces[index], [&](std::int32_t wall_node) { hold(mesh.host[wall_node], axes); });
  }
  // A face that moves as a whole is held along whatever one of its nodes is held along.
  void tie(const distributed::Face& face, const std::vector<char>& moved) {
    std::set<std::int32_t> nodes;
    for_each_node(face, [&](std::int32_t wall_node) { nodes.insert(mesh.host[wall_node]); });
    parallel::agree(mesh.comm, [&] {
      for (const auto node : nodes)
        if (moved[node])
          throw InputError("boundary." + face.name,
                           "moves as a whole (`undeforming`) and shares nodes with a face that is moved by "
                           "`displacement` or moves as a whole itself",
                           "give the two faces no node in common");
    });
    double sums[9] = {};
    std::vector<std::int32_t> owned;
    for (const auto node : nodes) {
      if (node >= mesh.owned_nodes) continue;
      owned.push_back(node);
      for (int k = 0; k < 9; ++k) sums[k] += (k % 4 == 0 ? 1.0 : 0.0) - held[node].P(k / 3, k % 3);
    }
    parallel::global_sum(mesh.comm, sums);
    for (int j = 0; j < 3; ++j) {
      const Vec3<double> column{{sums[j], sums[3 + j], sums[6 + j]}};
      if (const double size = norm(column); size > 1e-9)
        for (const auto node : nodes) held[node].direction((1.0 / size) * column);
    }
    b.tied_nodes_.push_back(std::move(owned));
  }
  void tie_faces(const BoundaryInput& input) {
    std::vector<char> moved(mesh.nodes(), 0);
    const auto mark = [&](const std::string& name) {
      for_each_node(mesh.face(name), [&](std::int32_t wall_node) { moved[mesh.host[wall_node]] = 1; });
    };
    for (const auto& [name, condition] : input.conditions)
      if (std::holds_alternative<bc::Displacement>(condition)) mark(name);
    for (const auto& [name, condition] : input.conditions)
      if (bc::undeforming(condition)) {
        tie(mesh.face(name), moved);
        mark(name);
      }
  }
  void operator()(std::size_t, const bc::Free&) {}
  void operator()(std::size_t index, const bc::Symmetry&) {
    const auto& face = mesh.faces[index];
    const Vec3<double> normal = mean_normal(mesh, face);
    const double off = out_of_plane(mesh, face, normal);
    if (!(off <= bc::plane_tolerance))
      throw InputError(
          "boundary." + face.name,
          fmt::format("is a plane of symmetry, but its nodes are up to {:.3g} % of its radius off its mean "
                      "plane; {:g} % is allowed",
                      100 * off, 100 * bc::plane_tolerance),
          "give the condition to flat faces, each a face of its own");
    symmetry_faces.push_back(index);
    for_each_node(face, [&](std::int32_t node) {
      held[mesh.host[node]].direction(normal);
      symmetric[mesh.host[node]].direction(normal);
    });
  }
  void operator()(std::size_t index, const bc::VelocityProfile& c) {
    const auto& face = mesh.faces[index];
    const auto course = waveform(c.course);
    leave_open(index, c.directions);
    if (c.table) {
      const auto table =
          parallel::agree(mesh.comm, [&] { return bc::PointTable(c.over_face(), bc::velocity_columns); });
      if (table.steady())
        prescribe(face, c.directions, course_of(course),
                  [&](std::int32_t node) { return table.value(mesh.points[node]); });
      else
        prescribe(face, c.directions,
                  [course, table](const Vec3<double>& x, double t) { return course.value(t) * table.value(x, t); });
      return;
    }
    prescribe(face, c.directions,
              [course, velocity = bc::velocity_by_formula(c, mean_normal(mesh, face))](
                  const Vec3<double>& x, double t) { return course.value(t) * velocity(x, t); });
  }

  // Along some axes a velocity can be given only where a plane of symmetry is at right angles to one of them.
  void require_aligned(const distributed::Face& face) const {
    for_each_node(face, [&](std::int32_t node) {
      const auto& P = symmetric[node].P;
      if (std::abs(P(0, 1)) + std::abs(P(0, 2)) + std::abs(P(1, 2)) > 1e-3)
        throw InputError("boundary." + face.name,
                         "gives a velocity along some axes (`directions`) and meets a plane of symmetry that is at "
                         "right angles to none of them",
                         "turn the mesh so that the plane is, or give the velocity along all axes");
    });
  }

  // The flow of a profile along n is exact only where no plane of symmetry takes a part of n away.
  void require_upright(const distributed::Face& face, const Vec3<double>& normal) const {
    for_each_node(face, [&](std::int32_t node) {
      if (norm(symmetric[node].P * normal - normal) > 1e-3 && !interface_node[node])
        throw InputError("boundary." + face.name, "the flow meets a plane of symmetry at an angle",
                         "cut the opening at right angles to the plane, or prescribe a `profile`");
    });
  }
  void operator()(std::size_t index, const bc::Support& c) {
    SurfaceLoad load{.face = index, .kind = SurfaceLoad::Kind::support};
    load.support = parallel::agree(mesh.comm, [&] { return support_of(mesh.faces[index], c); });
    b.loads_.bind(load);
  }

  double support_value(const bc::SupportValue& value, const distributed::Face& face,
                       const std::array<std::int32_t, 3>& triangle, double lowest) const {
    if (const auto* constant = std::get_if<double>(&value)) return *constant;
    const auto& array = std::get<bc::FaceArray>(value);
    const auto& nodal = mesh.node_field(mesh::face_array_name(face.name, array.name)).values;
    for (const auto n : triangle)
      if (!(nodal[n] * array.unit >= lowest))
        throw InputError("boundary." + face.name,
                         "point array " + array.name + " is " + std::to_string(nodal[n]) + " in a node, allowed is " +
                             std::to_string(lowest) + " or more",
                         "mend the array in the mesh file");
    return array.unit * (nodal[triangle[0]] + nodal[triangle[1]] + nodal[triangle[2]]) / 3.0;
  }
  std::vector<wall::TissueSupport<double>> support_of(const distributed::Face& face, const bc::Support& c) const {
    std::vector<wall::TissueSupport<double>> list;
    for (const auto& t : face.triangles)
      list.push_back({support_value(c.stiffness, face, t, 0.0), support_value(c.damping, face, t, 0.0),
                      support_value(c.pressure, face, t, std::numeric_limits<double>::lowest()),
                      c.direction == bc::Support::Direction::normal});
    return list;
  }

  bool is_wall(std::size_t index) const {
    return mesh.regions[mesh.faces[index].region].kind == mesh::RegionKind::wall;
  }
};

Boundaries::Boundaries(const distributed::DistributedMesh& mesh, const assembly::BlockPattern& pattern,
                       const BoundaryInput& input)
    : mesh_(mesh), loads_(mesh, pattern, input.fluid) {
  check_inflows(input);
  Builder builder(*this, input);
  std::map<std::string, std::size_t> index_of;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) index_of[mesh.faces[f].name] = f;
  const auto apply = [&](auto wanted) {
    for (const auto& [name, condition] : input.conditions)
      if (wanted(condition)) {
        mesh.face(name);  // throws where there is no such face
        std::visit([&, index = index_of[name]](const auto& c) { builder(index, c); }, condition);
      }
  };
  const auto symmetry = [](const bc::Condition& c) { return std::holds_alternative<bc::Symmetry>(c); };
  const auto no_slip = [](const bc::Condition& c) { return std::holds_alternative<bc::NoSlip>(c); };
  apply(symmetry);
  apply([&](const bc::Condition& c) { return !symmetry(c) && !no_slip(c); });
  apply(no_slip);
  builder.tie_faces(input);
  bind_given(input, builder, index_of);
  // no_slip wins on shared nodes.
  std::vector<char> still(mesh.nodes(), 0);
  for (const auto& [name, condition] : input.conditions)
    if (std::holds_alternative<bc::NoSlip>(condition))
      builder.for_each_node(mesh.face(name), [&](std::int32_t node) { still[node] = 1; });
  std::erase_if(prescribed_, [&](const PrescribedNode& p) { return still[p.node] != 0; });
  std::erase_if(field_nodes_, [&](const FieldNode& p) { return still[p.node] != 0; });
  builder.project_on_symmetry();
  find_inflow_nodes();

  hold_unknown_pressures(input, builder);
  hold_mesh(input, builder);
  constraints_ = assembly::Constraints(pattern, complete_on_ghosts(mesh, builder.held));
  mesh_constraints_ = complete_on_ghosts(mesh, builder.mesh_held);
  projector_of_.assign(mesh.nodes(), -1);
  for (const auto& c : constraints_.list()) {
    projector_of_[c.node] = static_cast<std::int32_t>(projector_.size());
    projector_.push_back(c.P);
  }
}

// Fields and pressures that only code can give.
void Boundaries::bind_given(const BoundaryInput& input, Builder& builder,
                            const std::map<std::string, std::size_t>& index_of) {
  for (const auto& [name, field] : input.velocity_fields) builder.prescribe(mesh_.face(name), every_axis, field);
  for (const auto& [name, field] : input.traction_fields) {
    mesh_.face(name);
    loads_.bind(TractionField{index_of.at(name), field});
  }
  for (const auto& [name, nodal] : input.wall_pressures) {
    SurfaceLoad load{.face = index_of.at(mesh_.face(name).name), .kind = SurfaceLoad::Kind::follower_pressure};
    for (const auto& t : mesh_.face(name).triangles)
      load.pressures.push_back((nodal[t[0]] + nodal[t[1]] + nodal[t[2]]) / 3.0);
    loads_.bind(load);
  }
}

void Boundaries::hold_unknown_pressures(const BoundaryInput& input, Builder& builder) {
  // Wall nodes of the displacement element, and wall-only parts of the mesh without fluid, have no pressure unknown.
  std::vector<char> has_pressure(mesh_.nodes(), 0);
  for (const auto& region : mesh_.regions)
    if (region.kind == mesh::RegionKind::lumen || input.wall_has_pressure)
      for (const auto& element : region.elements)
        for (const auto node : element) has_pressure[node] = 1;
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    builder.held[i].pressure = builder.held[i].unused = has_pressure[i] == 0;
  if (input.pressure_point) builder.hold_pressure(*input.pressure_point);
  idle_pressures_ = find_idle_pressures(mesh_, builder.held);
  for (const auto& idle : idle_pressures_) builder.held[idle.node].pressure = true;
}

void Boundaries::hold_mesh(const BoundaryInput& input, Builder& builder) {
  // The mesh slides along openings and flat walls; curved walls at rest hold it.
  const auto still_face = [&](const std::string& name) {
    return std::any_of(input.conditions.begin(), input.conditions.end(),
                       [&](const auto& c) { return c.first == name && std::holds_alternative<bc::NoSlip>(c.second); });
  };
  for (const auto& face : mesh_.faces) {
    if (mesh_.regions[face.region].kind != mesh::RegionKind::lumen) continue;
    const bool coupled = std::any_of(input.interfaces.begin(), input.interfaces.end(),
                                     [&](const auto& pair) { return pair.first == face.name; });
    if (coupled) continue;
    const Vec3<double> normal = mean_normal(mesh_, face);
    const bool rigid = still_face(face.name) && !(out_of_plane(mesh_, face, normal) <= bc::plane_tolerance);
    builder.for_each_node(face, [&](std::int32_t node) {
      if (rigid)
        builder.mesh_held[node].all();
      else
        builder.mesh_held[node].direction(normal);
    });
  }
}

void Boundaries::find_inflow_nodes() {
  inflow_profiles_.assign(at(mesh_.nodes()), 0.0);
  for (std::size_t k = 0; k < inflows_.size(); ++k)
    for (const auto& p : prescribed_) {
      if (p.course != inflows_[k].course) continue;
      for (int i = 0; i < 3; ++i) inflow_profiles_[at(p.node) + i] = p.velocity[i];
      inflow_profiles_[at(p.node) + 3] = static_cast<double>(k + 1);
    }
  mesh_.halo.update(inflow_profiles_, 4);
  for (std::int32_t node = 0; node < mesh_.nodes(); ++node)
    if (const double number = inflow_profiles_[at(node) + 3]; number > 0)
      inflow_nodes_.push_back({node, vector_at(inflow_profiles_.data(), node), static_cast<std::size_t>(number) - 1});
}

std::vector<Boundaries::FaceFlow> Boundaries::prescribed_flows(double t) const {
  std::vector<FaceFlow> flows;
  for (const auto& inflow : inflows_) flows.push_back({inflow.face, -courses_[inflow.course](t)});
  return flows;
}

std::vector<Boundaries::FaceFlow> Boundaries::actual_flows(const FieldsView& fields) const {
  std::vector<double> sums;
  for (const auto& inflow : inflows_) sums.push_back(owned_flow(mesh_, mesh_.faces[inflow.face], fields));
  parallel::global_sum(mesh_.comm, sums);
  std::vector<FaceFlow> flows;
  for (std::size_t k = 0; k < inflows_.size(); ++k) flows.push_back({inflows_[k].face, sums[k]});
  return flows;
}

void Boundaries::scale_inflows(std::span<const FaceFlow> flows, double weight, const FieldsView& fields,
                               std::span<double> velocity_pressure) const {
  const std::vector<double> at_rest(inflow_profiles_.size(), 0.0);
  FieldsView profiles = fields;
  profiles.velocity_pressure = inflow_profiles_.data();
  profiles.mesh_velocity = at_rest.data();
  const auto actual = actual_flows(fields), of_unit = actual_flows(profiles);
  for (const auto& n : inflow_nodes_) {
    const auto k = n.inflow;
    const double change = (flows[k].outward - actual[k].outward) / (weight * of_unit[k].outward);
    for (int i = 0; i < 3; ++i) velocity_pressure[at(n.node) + i] += change * n.velocity[i];
  }
}

void Boundaries::prescribe(double t, std::span<double> velocity_pressure) const {
  std::vector<double> values;
  values.reserve(courses_.size());
  for (const auto& course : courses_) values.push_back(course(t));
  const auto set = [&](std::int32_t node, const bc::Axes& axes, const Vec3<double>& v) {
    for (int i = 0; i < 3; ++i)
      if (axes[static_cast<std::size_t>(i)]) velocity_pressure[at(node) + i] = v[i];
  };
  for (const auto& p : prescribed_) set(p.node, p.axes, values[p.course] * p.velocity);
  for (const auto& p : field_nodes_)
    set(p.node, p.axes, p.allowed * velocity_fields_[p.field](mesh_.points[p.node], t));
  if (pressure_node_ >= 0) velocity_pressure[at(pressure_node_) + 3] = held_pressure_;
  mesh_.halo.update(velocity_pressure, 4);
}

std::vector<bc::Outlet> Boundaries::make_outlets() const {
  std::vector<bc::Outlet> list;
  for (const auto& outlet : outlets_) list.emplace_back(mesh_.faces[outlet.face].name, outlet.model);
  return list;
}

std::vector<double> Boundaries::outlet_flows(const FieldsView& fields) const {
  std::vector<double> flows;
  for (const auto& outlet : outlets_) flows.push_back(owned_flow(mesh_, mesh_.faces[outlet.face], fields));
  parallel::global_sum(mesh_.comm, flows);
  return flows;
}

std::vector<assembly::RankOne> Boundaries::add_outlets(std::span<const double> pressures, const FieldsView& fields,
                                                       std::span<double> residual) const {
  std::vector<assembly::RankOne> list;
  for (std::size_t k = 0; k < outlets_.size(); ++k) {
    std::map<std::int32_t, Vec3<double>> area;
    const auto& face = mesh_.faces[outlets_[k].face];
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      Vec3<double> x[3];
      gather(fields.position, face.triangles[t], x);
      const Vec3<double> third = fluid::nodal_area_vector(x);
      for (const auto node : mesh_.quadratic ? face.edges[t] : face.triangles[t])
        if (node < mesh_.owned_nodes) area[node] = area[node] + third;
    }
    assembly::RankOne& term = list.emplace_back();
    for (const auto& [node, s] : area) {
      for (int i = 0; i < 3; ++i) residual[at(node) + i] += pressures[k] * s[i];
      const Vec3<double> free = projector_of_[node] < 0 ? s : projector_[projector_of_[node]] * s;
      term.nodes.push_back(node);
      term.s.push_back({free[0], free[1], free[2]});
    }
  }
  return list;
}

}  // namespace tunica::coupling
