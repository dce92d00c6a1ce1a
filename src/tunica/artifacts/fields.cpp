#include "tunica/artifacts/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/field_io/array_name.hpp"
#include "tunica/quantities/names.hpp"

namespace tunica::artifacts {

namespace dimension = config::dimension;
using coupling::State;
using mesh::RegionKind;
using quantities::Place;
using quantities::Quantity;
using quantities::Unit;

namespace {

/// Name and size of the unit that results have a quantity in.
std::pair<std::string, double> unit_of(const Quantity& quantity, const case_file::OutputUnits& units) {
  const auto sized = [](const std::string& unit, const config::Dimension& of) {
    return std::pair{unit, config::unit_factor(unit, of)};
  };
  switch (quantity.unit) {
    case Unit::length:
      return sized(units.length, dimension::length);
    case Unit::velocity:
      return sized(units.velocity, dimension::velocity);
    case Unit::pressure:
      return sized(units.pressure, dimension::pressure);
    case Unit::stress:
      return sized(units.stress, dimension::pressure);
    case Unit::pascal:
      return {"Pa", 1.0};
    case Unit::per_second:
      return {"1/s", 1.0};
    case Unit::metre_per_second_squared:
      return {"m/s^2", 1.0};
    case Unit::none:
      break;
  }
  return {"", 1.0};
}

std::string one_of(const std::vector<std::string>& names) {
  std::string text = "name one of:";
  for (const auto& name : names) text += (text.back() == ':' ? " " : ", ") + name;
  return text;
}

bool has(Place place, RegionKind kind) {
  return place == Place::nodes || (place == Place::lumen_nodes) == (kind == RegionKind::lumen);
}

/// Zero at nodes that are none of the region's: in one array of unknowns they have what other regions mean by it.
void clear_elsewhere(const distributed::Region& region, const distributed::DistributedMesh& mesh,
                     quantities::Table& table) {
  std::vector<bool> here(static_cast<std::size_t>(mesh.nodes()), false);
  for (const auto& element : region.elements)
    for (const auto node : element) here[static_cast<std::size_t>(node)] = true;
  for (const auto& edges : region.edges)
    for (const auto node : edges) here[static_cast<std::size_t>(node)] = true;
  for (std::size_t n = 0; n < here.size(); ++n)
    if (!here[n])
      std::fill_n(table.values.begin() + static_cast<std::ptrdiff_t>(n * table.columns), table.columns, 0.0);
}

}  // namespace

OutputFields::OutputFields(const coupling::Problem& problem, const case_file::Case& c)
    : problem_(problem),
      units_(c.output.units),
      at_end_(c.output.instant == case_file::Instant::end),
      moves_(!std::holds_alternative<case_file::StaticWall>(c.analysis)) {
  if (c.solves_fluid()) inside_ = quantities::inside_of(problem);
  const auto& all = quantities::registry();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (c.output.fields[i] && (moves_ || !all[i].of_motion)) chosen_.push_back(&all[i]);
}

template <class See>
auto OutputFields::at_instant(const State& state, const See& see) const {
  if (!at_end_) return see(state, problem_.fields_with_pressure(state));
  const State end = coupling::with_end_pressure(state);
  return see(end, coupling::FieldsView{.velocity_pressure = end.velocity_pressure.data(),
                                       .acceleration = end.acceleration.data(),
                                       .displacement = end.displacement.data()});
}

void OutputFields::write(distributed::ResultsWriter& writer, std::int64_t step, double time, const State& state) {
  at_instant(state, [&](const State& shown, const coupling::FieldsView& wall) {
    write_instant(writer, step, time, shown, wall);
  });
}

quantities::Table OutputFields::table(const std::string& key, const std::string& region, const State& state) {
  const Quantity* quantity = quantities::find(key);
  if (!quantity) throw InputError("quantity " + key, "there is none of this name", one_of(quantities::keys()));
  const auto& regions = problem_.mesh().regions;
  const auto found = std::find_if(regions.begin(), regions.end(), [&](const auto& r) { return r.name == region; });
  if (found == regions.end()) {
    std::vector<std::string> names;
    for (const auto& r : regions) names.push_back(r.name);
    throw InputError("region " + region, "the mesh has no region of this name", one_of(names));
  }
  const auto none = [&] {
    return InputError("quantity " + key, fmt::format("region {} has none: {}", region, quantity->help),
                      "name another region or quantity");
  };
  if (!has(quantity->place, found->kind) || !quantity->given(problem_) || (quantity->of_motion && !moves_))
    throw none();
  return at_instant(state, [&](const State& shown, const coupling::FieldsView& wall) {
    quantities::Moment moment(problem_, inside_, shown, wall);
    const auto r = static_cast<std::size_t>(found - regions.begin());
    const auto entries = quantity->place == Place::wall_elements ? found->owned_elements : problem_.mesh().nodes();
    const auto arrays = quantity->values(moment, r);
    if (arrays.empty()) throw none();
    auto table = quantities::table_of(arrays, quantity->components, static_cast<std::size_t>(entries));
    if (quantity->place == Place::lumen_nodes || quantity->place == Place::wall_nodes)
      clear_elsewhere(*found, problem_.mesh(), table);
    return table;
  });
}

void OutputFields::write_instant(distributed::ResultsWriter& writer, std::int64_t step, double time, const State& state,
                                 const coupling::FieldsView& wall) {
  quantities::Moment moment(problem_, inside_, state, wall);
  const auto& regions = problem_.mesh().regions;
  std::vector<std::vector<quantities::Values>> kept;  // what the arrays show
  std::vector<distributed::NodalArray> nodal;
  std::vector<distributed::CellArray> cells;
  const auto add = [&](const Quantity& quantity, std::size_t region) {
    const auto [unit, factor] = unit_of(quantity, units_);
    kept.push_back(quantity.values(moment, region));
    for (const auto& values : kept.back()) {
      const std::string plain = quantity.name + values.name,
                        name = unit.empty() ? plain : field_io::array_name(plain, unit);
      const auto of = static_cast<std::int32_t>(region);
      if (quantity.place == Place::wall_elements)
        cells.push_back({.name = name,
                         .region = of,
                         .components = quantity.components,
                         .values = values.values(),
                         .factor = 1 / factor});
      else
        nodal.push_back({.name = name,
                         .components = quantity.components,
                         .values = values.values(),
                         .stride = values.stride,
                         .factor = 1 / factor,
                         .region = quantity.place == Place::nodes ? -1 : of});
    }
  };
  for (const Quantity* quantity : chosen_) {
    if (quantity->place == Place::nodes) {
      if (quantity->given(problem_)) add(*quantity, 0);
      continue;
    }
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (has(quantity->place, regions[r].kind) && quantity->given(problem_)) add(*quantity, r);
  }
  writer.write(step, time, nodal, cells);
}

}  // namespace tunica::artifacts
