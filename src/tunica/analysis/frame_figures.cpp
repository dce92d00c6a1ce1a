#include "tunica/analysis/frame_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tunica/analysis/cycle.hpp"
#include "tunica/fluid/boundary.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/parallel/message.hpp"

namespace tunica::analysis {

using mesh::RegionKind;

namespace column {

std::string station(std::size_t station, std::size_t lumen, const char* what) {
  return fmt::format("station {} {} {}", station, lumen_names[lumen], what);
}
std::string opening(const std::string& face, const char* what) { return fmt::format("opening {} {}", face, what); }
std::string tear(const std::string& tear, const char* what) { return fmt::format("{} {}", tear, what); }
std::string stress(const std::string& part, const std::string& quantity, const std::string& statistic) {
  return fmt::format("{}: {}: {}", part, quantity, statistic);
}

}  // namespace column

namespace {

Vec3<double> vector_at(std::span<const double> field, std::int64_t node) {
  if (field.empty()) return {{0, 0, 0}};
  const double* v = field.data() + 3 * static_cast<std::size_t>(node);
  return {{v[0], v[1], v[2]}};
}

/// Nodes of a region and their share of its volume: what a mean over the volume weighs them with.
std::vector<std::pair<std::int64_t, double>> node_shares(const mesh::MeshData& data, const std::string& name,
                                                         const std::vector<double>& volumes) {
  std::map<std::int64_t, double> shares;
  double total = 0;
  for (const auto& region : data.regions)
    if (region.kind == RegionKind::wall && region.name == name)
      for (auto e = region.first_element; e < region.end_element; ++e) {
        total += volumes[static_cast<std::size_t>(e)];
        for (const auto node : data.tetrahedra[static_cast<std::size_t>(e)])
          shares[node] += 0.25 * volumes[static_cast<std::size_t>(e)];
      }
  std::vector<std::pair<std::int64_t, double>> result(shares.begin(), shares.end());
  for (auto& [node, share] : result) share /= total;
  return result;
}

}  // namespace

FrameFigures::FrameFigures(const RunDescription& run, const PostSettings& settings, const mesh::MeshData& data,
                           const Vessel& vessel, std::vector<std::string> stresses, std::vector<double> start)
    : settings_(settings),
      data_(data),
      vessel_(vessel),
      stresses_(std::move(stresses)),
      start_(std::move(start)),
      wall_parts_(analysis::wall_parts(run, data)) {
  for (const auto& t : data.tetrahedra) volumes_.push_back(mesh::volume(data.points, t));
  for (const auto& t : vessel.inside) inside_.insert(inside_.end(), t.begin(), t.end());
  std::sort(inside_.begin(), inside_.end());
  inside_.erase(std::unique(inside_.begin(), inside_.end()), inside_.end());
  if (run.wall) flap_ = node_shares(data, settings.flap, volumes_);
}

FigureTable::Row FrameFigures::evaluate(const FieldFrame& frame, const std::vector<double>& mesh_velocity) const {
  const NodalFields fields{&data_.points, frame.displacement, frame.velocity, mesh_velocity, frame.pressure};
  FigureTable::Row row;
  if (lumen_region(data_)) flow_figures(fields, row);
  if (!vessel_.side.empty()) volume_figures(fields, row);
  if (!flap_.empty()) flap_figures(frame, row);
  stress_figures(frame, row);
  return row;
}

void FrameFigures::flow_figures(const NodalFields& fields, FigureTable::Row& row) const {
  for (std::size_t s = 0; s < vessel_.stations.size(); ++s)
    for (std::size_t lumen = 0; lumen < 2; ++lumen) {
      const auto& section = vessel_.stations[s].sections[lumen];
      if (section.empty()) continue;
      const auto figures = analysis::evaluate(section, fields);
      row.emplace_back(column::station(s, lumen, "area"), norm(figures.area));
      row.emplace_back(column::station(s, lumen, "pressure"), figures.mean_pressure);
      row.emplace_back(column::station(s, lumen, "flow"), figures.flow);
    }
  for (const auto& tear : vessel_.tears) {
    const auto figures = analysis::evaluate(tear.surface, fields);
    row.emplace_back(column::tear(tear.name, "flow"), figures.flow);
    row.emplace_back(column::tear(tear.name, "area"), figures.size);
  }
  for (const auto& opening : vessel_.openings) {
    double flow = 0, force = 0, area = 0;
    for (const auto& t : data_.faces[opening.face].triangles) {
      Vec3<double> x[3], v[3], w[3];
      double p[3];
      for (int i = 0; i < 3; ++i) {
        x[i] = data_.points[static_cast<std::size_t>(t[i])] + vector_at(fields.displacement, t[i]);
        v[i] = vector_at(fields.velocity, t[i]);
        w[i] = vector_at(fields.mesh_velocity, t[i]);
        p[i] = fields.pressure[static_cast<std::size_t>(t[i])];
      }
      flow += fluid::flow(x, v, w);
      force += fluid::integrated_pressure(x, p);
      area += fluid::area(x);
    }
    row.emplace_back(column::opening(opening.name, "flow"), flow);
    row.emplace_back(column::opening(opening.name, "pressure"), force / area);
  }
}

// The part of an element that belongs to the false lumen moves affinely with it, so its share of the volume stays;
// dV/dt = V div w.
void FrameFigures::volume_figures(const NodalFields& fields, FigureTable::Row& row) const {
  double whole = 0, part = 0, rate = 0;
  const auto* lumen = lumen_region(data_);
  for (auto e = lumen->first_element; e < lumen->end_element; ++e) {
    const auto& nodes = data_.tetrahedra[static_cast<std::size_t>(e)];
    const double share = vessel_.false_share[static_cast<std::size_t>(e - lumen->first_element)];
    Vec3<double> x[4];
    for (int a = 0; a < 4; ++a)
      x[a] = data_.points[static_cast<std::size_t>(nodes[a])] + vector_at(fields.displacement, nodes[a]);
    const auto shape = fe::gradients(x);
    whole += shape.volume;
    part += share * shape.volume;
    for (int a = 0; a < 4 && share > 0; ++a)
      rate += share * shape.volume * dot(shape.dN[a], vector_at(fields.mesh_velocity, nodes[a]));
  }
  row.emplace_back(column::true_volume, whole - part);
  row.emplace_back(column::false_volume, part);
  row.emplace_back(column::false_volume_rate, rate);
}

void FrameFigures::flap_figures(const FieldFrame& frame, FigureTable::Row& row) const {
  double mean = 0, largest = 0;
  for (const auto& [node, share] : flap_) {
    const double moved = norm(vector_at(frame.displacement, node) - vector_at(start_, node));
    mean += share * moved;
    largest = std::max(largest, moved);
  }
  row.emplace_back(column::flap_mean, mean);
  row.emplace_back(column::flap_largest, largest);
}

double FrameFigures::volume_of(const WallPart& part) const {
  double volume = 0;
  for (const auto e : part.elements) volume += volumes_[static_cast<std::size_t>(e)];
  return volume;
}

std::vector<std::pair<double, double>> FrameFigures::values_in(const WallPart& part,
                                                               const std::vector<double>& of_elements) const {
  std::vector<std::pair<double, double>> values;
  for (const auto e : part.elements)
    if (const double v = of_elements[static_cast<std::size_t>(e)]; std::isfinite(v))
      values.emplace_back(v, volumes_[static_cast<std::size_t>(e)]);
  return values;
}

void FrameFigures::stress_figures(const FieldFrame& frame, FigureTable::Row& row) const {
  for (const auto& part : wall_parts_)
    for (std::size_t q = 0; q < stresses_.size(); ++q) {
      const auto values = values_in(part, frame.stress[q]);
      double sum = 0, volume = 0;
      for (const auto& [value, weight] : values) {
        sum += weight * value;
        volume += weight;
      }
      row.emplace_back(column::stress(part.name, stresses_[q], "mean"), sum / volume);
      const auto found = percentiles(values, settings_.percentiles);
      for (std::size_t p = 0; p < found.size(); ++p)
        row.emplace_back(column::stress(part.name, stresses_[q], fmt::format("{:g}", settings_.percentiles[p])),
                         found[p]);
    }
}

CycleFields FrameFigures::no_fields() const {
  CycleFields fields;
  if (!inside_.empty()) fields.shear.resize(4 * data_.points.size(), 0.0);
  fields.max_stress.assign(stresses_.size(),
                           std::vector<double>(data_.tetrahedra.size(), std::numeric_limits<double>::quiet_NaN()));
  return fields;
}

void FrameFigures::add(const FieldFrame& frame, double weight, CycleFields& fields) const {
  for (const auto node : inside_) {
    const auto tau = vector_at(frame.wall_shear, node);
    double* sums = fields.shear.data() + 4 * static_cast<std::size_t>(node);
    sums[0] += weight * norm(tau);
    for (int c = 0; c < 3; ++c) sums[1 + c] += weight * tau[c];
  }
  for (std::size_t q = 0; q < frame.stress.size(); ++q) {
    auto& most = fields.max_stress[q];
    for (std::size_t e = 0; e < most.size(); ++e) most[e] = std::fmax(most[e], frame.stress[q][e]);
  }
}

void gather(MPI_Comm comm, CycleFields& fields) {
  const bool root = parallel::rank(comm) == 0;
  const auto reduce = [&](std::vector<double>& values, MPI_Op operation) {
    MPI_Reduce(root ? MPI_IN_PLACE : values.data(), root ? values.data() : nullptr, static_cast<int>(values.size()),
               MPI_DOUBLE, operation, 0, comm);
  };
  reduce(fields.shear, MPI_SUM);
  for (auto& stress : fields.max_stress) {
    // MPI_MAX says nothing about NaN.
    for (auto& v : stress)
      if (std::isnan(v)) v = std::numeric_limits<double>::lowest();
    reduce(stress, MPI_MAX);
    for (auto& v : stress)
      if (v == std::numeric_limits<double>::lowest()) v = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace tunica::analysis
