#include "tunica/coupling/prestress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/coupling/anderson.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/coupling/unloading.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

using Method = PrestressSettings::Method;
using Update = PrestressSettings::Update;

constexpr int most_load_steps = 256;
constexpr double growth = 1.5;  // of the displacement that an update may cause
constexpr double least_relaxation = 1.0 / 128;
constexpr std::size_t memory = 5;  // points of the acceleration

WallPrestress without_prestress(const distributed::DistributedMesh& mesh, Method method) {
  WallPrestress p{.kind = method == Method::stress ? wall::PrestressKind::stress : wall::PrestressKind::stretch};
  const auto n = static_cast<std::size_t>(wall::components(p.kind) * prestress_points(mesh.quadratic));
  for (const auto& region : mesh.regions) {
    auto& values = p.values.emplace_back();
    if (region.kind != mesh::RegionKind::wall) continue;
    values.assign(n * region.elements.size(), 0.0);
    if (method != Method::stress)
      for (std::size_t k = 0; k < values.size(); k += 9) values[k] = values[k + 4] = values[k + 8] = 1.0;
  }
  return p;
}

Method as_method(PrestressSettings::Fallback fallback) {
  return fallback == PrestressSettings::Fallback::stress ? Method::stress : Method::stretch;
}

std::vector<double> flat(const WallPrestress& prestress) {
  std::vector<double> values;
  for (const auto& region : prestress.values) values.insert(values.end(), region.begin(), region.end());
  return values;
}

class FixedPoint {
 public:
  using Follow = std::function<void(const PrestressRecord&)>;
  FixedPoint(Problem& problem, const PrestressSettings& settings, Method method, double load_time, const Follow& follow)
      : problem_(problem),
        settings_(settings),
        method_(method),
        mesh_(problem.mesh()),
        follow_(follow),
        start_(problem.initial_state()) {
    find_prestressed_nodes();
    start_.time = load_time;
    result_.method = method;
  }

  PrestressResult run();

 private:
  bool excluded(const distributed::Region& region) const {
    return std::find(settings_.exclude.begin(), settings_.exclude.end(), region.name) != settings_.exclude.end();
  }
  void find_prestressed_nodes();
  void find_largest_displacement(const State& state, PrestressRecord& record) const;
  /// Equilibrium under a share of the load with the present prestress, from rest; none when Newton's method fails.
  std::optional<State> solve(double load, double relaxation);
  /// Back to no prestress, then all but the last of `steps` shares of the load, with an update after each.
  bool ramp(int steps);
  std::optional<State> first_solution();
  /// What the fixed point is of: the prestress, or the motion from the unloaded shape to the image [local node][3].
  std::vector<double> unknown() const;
  std::vector<double> updated_unknown(const State& loaded) const;
  WallPrestress updated(const State& loaded) const;
  /// `values`: the present prestress of the point q of an element, afterwards its next one.
  void update_point(const State& loaded, std::size_t region, std::size_t element, int q, double* values) const;
  void set(const std::vector<double>& values);
  std::vector<double> displacements(const State& state) const;  ///< [prestressed owned node][3]
  /// What the next solution starts from: back in the imaged shape.
  State rest(const State& loaded) const;

  Problem& problem_;
  const PrestressSettings& settings_;
  const Method method_;
  const distributed::DistributedMesh& mesh_;
  const Follow& follow_;
  State start_;                    ///< undeformed
  bool inverted_ = false;          ///< the unloaded shape that was set last has inverted elements
  std::vector<char> prestressed_;  ///< [owned node]
  PrestressResult result_;
};

void FixedPoint::find_prestressed_nodes() {
  prestressed_.assign(static_cast<std::size_t>(mesh_.nodes()), 0);
  std::vector<std::string> left = settings_.exclude;
  std::string names;
  for (const auto& region : mesh_.regions) {
    if (region.kind != mesh::RegionKind::wall) continue;
    names += (names.empty() ? "" : ", ") + region.name;
    std::erase(left, region.name);
    if (excluded(region)) continue;
    distributed::for_each_node(region, [&](std::int32_t node) { prestressed_[static_cast<std::size_t>(node)] = 1; });
  }
  if (!left.empty())
    throw InputError("prestress.exclude", "the mesh has no wall region " + left.front(), "use one of: " + names);
}

void FixedPoint::find_largest_displacement(const State& state, PrestressRecord& record) const {
  double largest = 0.0;
  Vec3<double> place{};
  for (std::int32_t i = 0; i < mesh_.owned_nodes; ++i) {
    const double u = norm(vector_at(state.displacement.data(), i));
    if (prestressed_[static_cast<std::size_t>(i)] && u > largest) largest = u, place = mesh_.points[i];
  }
  record.displacement = parallel::global_max(mesh_.comm, largest);
  const std::int64_t rank = parallel::rank(mesh_.comm), ranks = parallel::size(mesh_.comm);
  const bool here = parallel::global_min(mesh_.comm, largest == record.displacement ? rank : ranks) == rank;
  double x[3] = {};
  for (int c = 0; c < 3 && here; ++c) x[c] = place[c];
  parallel::global_sum(mesh_.comm, x);
  record.place = {{x[0], x[1], x[2]}};
}

std::vector<double> FixedPoint::displacements(const State& state) const {
  std::vector<double> u;
  for (std::int32_t i = 0; i < mesh_.owned_nodes; ++i)
    for (std::size_t c = 0; c < 3 && prestressed_[static_cast<std::size_t>(i)]; ++c)
      u.push_back(state.displacement[at(i) + c]);
  return u;
}

std::optional<State> FixedPoint::solve(double load, double relaxation) {
  State loaded = result_.state;
  StepReport report;
  if (inverted_)
    report.failure = "an element of the unloaded shape is inverted";
  else
    report = problem_.solve_static(loaded, load);
  PrestressRecord& record = result_.history.emplace_back();
  record.iteration = static_cast<int>(result_.history.size());
  record.load = load;
  record.relaxation = relaxation;
  record.newton = static_cast<int>(report.iterations.size());
  record.linear = report.linear_iterations();
  record.seconds = report.timings.total;
  record.displacement = std::numeric_limits<double>::quiet_NaN();
  if (report.converged) find_largest_displacement(loaded, record);
  record.failure = result_.failure = report.failure;
  follow_(record);
  if (!report.converged) return std::nullopt;
  return loaded;
}

bool FixedPoint::ramp(int steps) {
  result_.prestress = without_prestress(mesh_, method_);
  result_.state = start_;
  inverted_ = false;
  if (method_ == Method::inverse) result_.unloading.assign(3 * static_cast<std::size_t>(mesh_.nodes()), 0.0);
  problem_.set_prestress(result_.prestress);
  for (int k = 1; k < steps; ++k) {
    const auto loaded = solve(static_cast<double>(k) / steps, k == 1 ? 0.0 : 1.0);
    if (!loaded) return false;
    set(updated_unknown(*loaded));
    result_.state = rest(*loaded);
  }
  return true;
}

std::optional<State> FixedPoint::first_solution() {
  for (int steps = settings_.load_steps; steps <= most_load_steps; steps *= 2)
    if (ramp(steps))
      if (auto loaded = solve(1.0, steps == 1 ? 0.0 : 1.0)) return loaded;
  return std::nullopt;
}

// (5.3) to (5.5). `loaded` is in equilibrium with the present prestress.
WallPrestress FixedPoint::updated(const State& loaded) const {
  WallPrestress next = result_.prestress;
  const int points = prestress_points(mesh_.quadratic), n = wall::components(next.kind);
  for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
    const auto& region = mesh_.regions[r];
    if (region.kind != mesh::RegionKind::wall || excluded(region)) continue;
    double* values = next.values[r].data();
    for (std::size_t e = 0; e < region.elements.size(); ++e)
      for (int q = 0; q < points; ++q, values += n) update_point(loaded, r, e, q, values);
  }
  return next;
}

void FixedPoint::update_point(const State& loaded, std::size_t r, std::size_t e, int q, double* values) const {
  const Mat3<double> F = motion_gradient(mesh_, loaded.displacement, 4, mesh_.regions[r], e, q);
  if (method_ == Method::stretch) {
    Mat3<double> F0;
    for (int k = 0; k < 9; ++k) F0(k / 3, k % 3) = values[k];
    F0 = F * F0;
    for (int k = 0; k < 9; ++k) values[k] = F0(k / 3, k % 3);
    return;
  }
  const WallModel& model = problem_.wall_model();
  const auto element = static_cast<std::int32_t>(e);
  const auto sigma = point_cauchy_stress(model, r, element, q, wall_point(mesh_, model, loaded, r, element, q));
  const Mat3<double> P = wall::full(sigma) * transpose(adjugate(F));  // J sigma F^-T
  const Mat3<double> S = settings_.update == Update::first_piola ? P : inverse(F) * P;
  for (int n = 0; n < wall::voigt_size; ++n) {
    const int i = wall::voigt_row[n], j = wall::voigt_column[n];
    values[n] = 0.5 * (S(i, j) + S(j, i));
  }
}

State FixedPoint::rest(const State& loaded) const {
  State state = loaded;
  std::fill(state.displacement.begin(), state.displacement.end(), 0.0);
  if (method_ == Method::stress) std::fill(state.velocity_pressure.begin(), state.velocity_pressure.end(), 0.0);
  state.residual_reference = 0.0;
  return state;
}

std::vector<double> FixedPoint::unknown() const {
  return method_ == Method::inverse ? result_.unloading : flat(result_.prestress);
}

// (5.8) moves the stress-free shape back by what the wall moves under the load (Sellier 2011).
std::vector<double> FixedPoint::updated_unknown(const State& loaded) const {
  if (method_ != Method::inverse) return flat(updated(loaded));
  std::vector<double> U = result_.unloading;
  for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
    for (std::size_t c = 0; c < 3; ++c) U[3 * static_cast<std::size_t>(i) + c] += loaded.displacement[at(i) + c];
  return U;
}

void FixedPoint::set(const std::vector<double>& values) {
  if (method_ == Method::inverse) {
    result_.unloading = values;
    auto prestretch = prestretch_of(mesh_, values);
    inverted_ = parallel::global_max(mesh_.comm, prestretch ? 0.0 : 1.0) > 0;
    if (inverted_) return;
    result_.prestress = std::move(*prestretch);
  } else {
    auto value = values.begin();
    for (auto& region : result_.prestress.values)
      for (double& component : region) component = *value++;
  }
  problem_.set_prestress(result_.prestress);
}

PrestressResult FixedPoint::run() {
  double relaxation = settings_.relaxation, last = std::numeric_limits<double>::infinity();
  std::vector<double> x, g;  // prestress that was solved with last, and its update
  Anderson anderson(mesh_.comm, memory);
  auto loaded = first_solution();
  if (!loaded) return std::move(result_);
  for (int k = 1;; ++k) {
    const double displacement = result_.history.back().displacement;
    if (displacement <= settings_.tolerance) {
      result_.state = rest(*loaded);
      result_.converged = true;
      return std::move(result_);
    }
    if (k == settings_.max_iterations) break;
    if (displacement < growth * last) {  // false for NaN
      last = displacement;
      x = unknown();
      g = updated_unknown(*loaded);
      for (std::size_t i = 0; i < g.size(); ++i) g[i] -= x[i];
      result_.state = rest(*loaded);
      if (k > 1) relaxation = std::min(settings_.relaxation, 2 * relaxation);
      set(anderson.next(x, g, displacements(*loaded), relaxation));
    } else {  // back to the last point, from which a smaller step is made
      relaxation *= 0.5;
      if (relaxation < least_relaxation) break;
      anderson.forget();
      std::vector<double> nearer = x;
      for (std::size_t i = 0; i < x.size(); ++i) nearer[i] += relaxation * g[i];
      set(nearer);
    }
    loaded = solve(1.0, relaxation);
  }
  result_.failure = fmt::format("after {} iterations the largest displacement is {:.3e} m, allowed are {:.3e} m{}",
                                result_.history.size(), last, settings_.tolerance,
                                result_.failure.empty() ? "" : "; the last solution failed: " + result_.failure);
  return std::move(result_);
}

}  // namespace

PrestressResult find_prestress(Problem& problem, const PrestressSettings& settings, double load_time,
                               const std::function<void(const PrestressRecord&)>& follow) {
  PrestressResult result = FixedPoint(problem, settings, settings.method, load_time, follow).run();
  if (result.converged || settings.method != Method::inverse) return result;
  if (!settings.fallback) return result;
  PrestressResult other = FixedPoint(problem, settings, as_method(*settings.fallback), load_time, follow).run();
  other.inverse_failure = result.failure;
  other.history.insert(other.history.begin(), result.history.begin(), result.history.end());
  return other;
}

}  // namespace tunica::coupling
