#include "tunica/case/tuning_settings.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tunica::case_file {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

namespace {

constexpr double largest_defect = 0.01;  ///< of the sum of the fractions

Schema<double> fraction_schema() {
  return Schema<double>("fraction", "Share of the mean outflow.")
      .number(
          "share", [](double& share) -> double& { return share; }, config::range(1e-6, 1), "Share")
      .shorthand("share");
}

void check_outlets(const TuningCase& outlets, Problems& problems) {
  if (outlets.systolic <= outlets.diastolic)
    problems.add("systolic", "is not above the diastolic pressure", "give `systolic: 125 mmHg, diastolic: 75 mmHg`");
  if (outlets.distal_pressure >= outlets.diastolic)
    problems.add("distal_pressure", "is not below the diastolic pressure", "leave it out: it is 0 then");
  if (outlets.fractions.empty()) {
    problems.add("fractions", "names no outlet", "give every outlet its share of the mean outflow");
    return;
  }
  double sum = 0;
  for (const auto& [face, share] : outlets.fractions) sum += share;
  if (std::abs(sum - 1) > largest_defect)
    problems.add("fractions", fmt::format("add up to {:.4g}, not to 1 within 1 %", sum),
                 "give shares of the mean outflow that add up to 1");
}

}  // namespace

Schema<TuningCase> TuningCase::schema() {
  return Schema<TuningCase>("outlets",
                            "Windkessel outlets that `tunica tune` finds for given pressures and shares of the flow, "
                            "and `tunica run` takes from its file.")
      .quantity("systolic", &TuningCase::systolic, dimension::pressure, config::above(0),
                "Largest pressure in a cycle at the face with the inflow, mean of the face")
      .plausible("60 mmHg", "250 mmHg")
      .quantity("diastolic", &TuningCase::diastolic, dimension::pressure, config::above(0), "Smallest pressure there")
      .plausible("30 mmHg", "150 mmHg")
      .map("fractions", &TuningCase::fractions, fraction_schema(),
           "Share of the mean outflow of every outlet, by the name of the face; these faces have no entry in "
           "`boundary`")
      .number("distal_share", &TuningCase::distal_share, config::between(0, 1),
              "Distal resistance over the sum of proximal and distal one")
      .by_default()
      .quantity("distal_pressure", &TuningCase::distal_pressure, dimension::pressure, config::at_least(0),
                "Pressure behind all outlets")
      .by_default()
      .number("tolerance", &TuningCase::tolerance, config::between(0, 0.5),
              "Difference of systolic and diastolic pressure that may remain, relative to the targets; also of the "
              "mean pressure from the one that the 0D model foresees")
      .by_default()
      .integer("max_cycles", &TuningCase::max_cycles, config::range(1, 20), "Most cycles that are computed in 3D")
      .by_default()
      .quantity("step", &TuningCase::step, dimension::time, config::above(0),
                "Time step of the tuning runs, made to fit into the period; a two-hundredth of it when left out")
      .plausible("0.01 ms", "30 ms")
      .path("output", &TuningCase::output, "Folder of what `tunica tune` finds, relative to that of the case file")
      .by_default("outlets")
      .path("file", &TuningCase::given_file,
            "The outlets found, written by `tunica tune` and read by `tunica run`; outlets.yaml in `output` when left "
            "out")
      .flag("continued", &TuningCase::continued,
            "The run starts from the end of a beat with these outlets, and their pressures go on from there; else "
            "they begin as the file has them, with the state of a periodic beat")
      .by_default()
      .check(check_outlets);
}

std::vector<std::pair<std::string, bc::Condition>> provisional_outlets(const TuningCase& outlets) {
  std::vector<std::pair<std::string, bc::Condition>> conditions;
  for (const auto& [face, share] : outlets.fractions)
    conditions.emplace_back(face, bc::Resistance{.resistance = 1e8 / share});
  return conditions;
}

zerod::FlowSplit TuningCase::flow_split() const {
  zerod::FlowSplit split{.fractions = {}, .distal_share = distal_share, .distal_pressure = distal_pressure};
  for (const auto& [face, share] : fractions) split.fractions.push_back(share);
  return split;
}

}  // namespace tunica::case_file
