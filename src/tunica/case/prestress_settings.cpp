#include "tunica/case/prestress_settings.hpp"

namespace tunica::case_file {

using config::Schema;
namespace dimension = config::dimension;

Schema<SteadyFlow> SteadyFlow::schema() {
  return Schema<SteadyFlow>("steady_flow", "Steady flow in the rigid vessel, whose traction loads the wall.")
      .quantity("pressure", &SteadyFlow::pressure, dimension::pressure, config::anything(),
                "Diastolic pressure: resistances take the place of all outlets, such that they are at this pressure")
      .plausible("20 mmHg", "150 mmHg")
      .quantity("inflow", &SteadyFlow::inflow, dimension::volume_flow, config::above(0),
                "Constant flow through the face that has a flow condition; needed where there is one")
      .plausible("1 ml/s", "500 ml/s")
      .quantity("step", &SteadyFlow::step, dimension::time, config::above(0), "Time step towards the steady state")
      .by_default()
      .plausible("0.01 ms", "20 ms")
      .integer("steps", &SteadyFlow::steps, config::range(2, 1000000), "Most steps towards the steady state")
      .by_default()
      .number("tolerance", &SteadyFlow::tolerance, config::range(1e-12, 0.5),
              "Largest change of velocity and pressure in a step, relative to the largest value, that counts as steady")
      .by_default();
}

Schema<PrestressCase> PrestressCase::schema() {
  return Schema<PrestressCase>("prestress", "Prestress of the wall, as `tunica prestress` finds it.")
      .include(&PrestressCase::fixed_point, coupling::PrestressSettings::schema())
      .section("flow", &PrestressCase::flow, SteadyFlow::schema(),
               "Steady flow in the rigid vessel, whose traction loads the wall; for `fsi`")
      .quantity("load_time", &PrestressCase::load_time, dimension::time, config::at_least(0),
                "Loads on the wall that vary in time are those of this time")
      .by_default()
      .path("output", &PrestressCase::output, "Folder of what is found, relative to that of the case file")
      .by_default("prestress");
}

}  // namespace tunica::case_file
