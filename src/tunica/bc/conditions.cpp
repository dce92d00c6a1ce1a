#include "tunica/bc/conditions.hpp"

#include <array>

namespace tunica::bc {

namespace {

struct Traits {
  std::string_view name;
  bool lumen, wall, velocity;
};

// In the order of the variant.
constexpr std::array<Traits, std::variant_size_v<Condition>> traits = {{{"no_slip", true, false, true},
                                                                        {"velocity", true, false, true},
                                                                        {"flow", true, false, true},
                                                                        {"pressure", true, true, false},
                                                                        {"traction", true, true, false},
                                                                        {"resistance", true, false, false},
                                                                        {"rcr", true, false, false},
                                                                        {"fixed", false, true, false},
                                                                        {"free", false, true, false},
                                                                        {"support", false, true, false},
                                                                        {"symmetry", true, true, true},
                                                                        {"profile", true, false, true},
                                                                        {"displacement", false, true, false}}};

}  // namespace

std::string_view name(const Condition& condition) { return traits[condition.index()].name; }
bool fits_lumen(const Condition& condition) { return traits[condition.index()].lumen; }
bool fits_wall(const Condition& condition) { return traits[condition.index()].wall; }

bool prescribes_velocity(const Condition& condition) {
  constexpr Axes all{true, true, true};
  if (const auto* velocity = std::get_if<Velocity>(&condition)) return velocity->directions == all;
  if (const auto* profile = std::get_if<VelocityProfile>(&condition)) return profile->directions == all;
  return traits[condition.index()].velocity;
}

Axes held_axes(const Condition& condition) {
  if (const auto* fixed = std::get_if<Fixed>(&condition)) return fixed->axes();
  if (const auto* pressure = std::get_if<Pressure>(&condition)) return pressure->fixed;
  if (const auto* traction = std::get_if<Traction>(&condition)) return traction->fixed;
  if (const auto* moved = std::get_if<Displacement>(&condition)) return moved->directions;
  return {};
}

bool undeforming(const Condition& condition) {
  if (const auto* pressure = std::get_if<Pressure>(&condition)) return pressure->undeforming;
  if (const auto* traction = std::get_if<Traction>(&condition)) return traction->undeforming;
  return false;
}

Waveform inflow(const Flow& flow) {
  const auto* table = std::get_if<TableSource>(&flow.course.source);
  const bool outflow = flow.positive == Flow::Sign::outflow ||
                       (flow.positive == Flow::Sign::automatic && table && is_simvascular(table->file));
  return make_waveform(flow.course).scaled(outflow ? -1.0 : 1.0);
}

std::vector<FaceArray> Support::arrays() const {
  std::vector<FaceArray> arrays;
  for (const auto* value : {&stiffness, &damping, &pressure})
    if (const auto* array = std::get_if<FaceArray>(value)) arrays.push_back(*array);
  return arrays;
}

}  // namespace tunica::bc
