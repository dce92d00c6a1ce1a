// fluid: density and viscosity law.
#include <fmt/format.h>

#include "tunica/base/text.hpp"
#include "tunica/peer_cases/problem.hpp"
#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

namespace {

void translate_casson(Context& context, const Entry& viscosity, CaseKey& law) {
  const auto square_root = [&](const char* key, const char* name, const char* unit) {
    const auto root = context.number(viscosity, key);
    if (!root) return context.refuse(viscosity, fmt::format("has no {}", key), "write it: the law needs it");
    law.add(name, with_unit(*root * *root, unit),
            fmt::format("{} {}, a square root", viscosity.find(key)->where(), number_text(*root)));
  };
  square_root("Asymptotic_viscosity_parameter", "viscosity_at_high_shear", context.units.viscosity);
  square_root("Yield_stress_parameter", "yield_stress", context.units.pressure);
  const double threshold = context.number(viscosity, "Low_shear_rate_threshold").value_or(0.5);
  law.add("regularising_shear_rate", with_unit(threshold, "1/s"),
          context.source(viscosity, "Low_shear_rate_threshold", fmt::format("the default of {}", context.peer())));
  if (viscosity.find("Low_shear_rate_threshold") == nullptr)
    context.defaulted(viscosity, "Low_shear_rate_threshold", fmt::format("0.5 1/s, the default of {}", context.peer()));
  context.changed(viscosity,
                  "below Low_shear_rate_threshold g0 the viscosity does not stay what it is at g0, the shear rate g "
                  "becomes sqrt(g^2 + g0^2)");
}

void translate_viscosity(Context& context, const Entry& properties, CaseKey& fluid) {
  const Entry* viscosity = properties.find("Viscosity");
  if (viscosity == nullptr)
    return context.refuse(properties, fmt::format("has no Viscosity; {} would compute without any", context.peer()),
                          "write it");
  const std::string model = text::lower(viscosity->label);
  auto& section = fluid.section("viscosity", viscosity->where() + " " + viscosity->label);
  const char* unit = context.units.viscosity;
  if (model == "const" || model == "constant" || model == "newtonian") {
    context.add_required(*viscosity, "Value", unit, section.section("newtonian", ""), "viscosity");
  } else if (model == "cy" || model == "carreau-yasuda") {
    auto& law = section.section("carreau_yasuda", "");
    context.add_required(*viscosity, "Limiting_high_shear_rate_viscosity", unit, law, "viscosity_at_high_shear");
    context.add_required(*viscosity, "Limiting_low_shear_rate_viscosity", unit, law, "viscosity_at_rest");
    context.add_required(*viscosity, "Shear_rate_tensor_multiplier", "s", law, "relaxation_time");
    context.add_required(*viscosity, "Shear_rate_tensor_exponent", "", law, "transition");
    context.add_required(*viscosity, "Power_law_index", "", law, "exponent");
  } else if (model == "cass" || model == "cassons") {
    translate_casson(context, *viscosity, section.section("casson", ""));
  } else {
    context.refuse(
        *viscosity,
        fmt::format("is of the model `{}`, which {} does not have", text::printable(viscosity->label), context.peer()),
        "write Constant, Carreau-Yasuda or Cassons");
  }
}

}  // namespace

void translate_fluid(Context& context, const PosedProblem& problem, CaseKey& top) {
  if (!problem.blood) return;
  const Entry& properties = *problem.blood->properties;
  auto& fluid = top.section("fluid", properties.where());
  if (const Entry* density = properties.find("Density")) {
    fluid.add("density", context.quantity(*density, context.units.density), density->where());
    check_blood_density(context.units, context.number(properties, "Density").value_or(0), density->where(),
                        context.problems);
  } else {
    context.defaulted(properties, "Density",
                      fmt::format("1060 kg/m^3, the default of tunica; {} would take 0.5", context.peer()));
  }
  translate_viscosity(context, properties, fluid);
  fluid.add("stabilisation", "vms_classic", "as the peer's");
  if (const Entry* backflow = properties.find("Backflow_stabilization_coefficient"))
    fluid.add("backflow_stabilisation", context.quantity(*backflow, ""), backflow->where());
  else
    context.defaulted(properties, "Backflow_stabilization_coefficient", "0.2, the default of both");
}

}  // namespace tunica::peer_cases
