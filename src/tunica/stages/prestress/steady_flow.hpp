// First two steps towards the prestress of a vessel: steady flow between rigid walls, and its traction.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/coupling/problem.hpp"

namespace tunica::stages {

using FaceConditions = std::vector<std::pair<std::string, bc::Condition>>;

/// The conditions of the steady flow on the lumen faces of a case: its own where the flow sticks, the constant inflow,
/// and for every outlet the resistance (with the case's shares of the flow: conductances of its outlets) that puts it
/// at the diastolic pressure; without any inflow that pressure itself, as on faces with a pressure condition. The flow
/// sticks at the interface. Throws InputError where the case prescribes a velocity or a traction, has several faces
/// with a flow, or the inflow is missing or not wanted.
FaceConditions steady_conditions(const FaceConditions& of_case, const std::vector<std::string>& lumen_faces,
                                 const std::vector<std::string>& interface_faces, const case_file::SteadyFlow& flow);

/// The same as YAML for the section `boundary` of a case, without the interface.
std::string conditions_text(const FaceConditions& conditions, const std::vector<std::string>& interface_faces);

struct SteadyRecord {
  int step = 0;
  double time = 0, dt = 0;                            ///< s
  double velocity_change = 0, pressure_change = 0;    ///< in the step, of the largest velocity and pressure
  double largest_velocity = 0, largest_pressure = 0;  ///< m/s, Pa
  bool last = false;                                  ///< the flow is steady, or the steps are used up
};

struct SteadySteps {
  SteadyRecord last;
  coupling::State before_last;  ///< what the last step started from; its dt is that of the step to come
  bool stopped = false;         ///< before its end
};

/// Steps `problem` from `state`, which may have some of the steps behind it, until nothing changes or the steps are
/// used up; one at least. A step that fails is halved; throws SolverError after six halvings. Stops after a step for
/// which `follow` says so, with the same result as without when it goes on from there. Collective.
SteadySteps step_to_steady_state(coupling::Problem& problem, coupling::State& state, const case_file::SteadyFlow& flow,
                                 const std::function<bool(const SteadyRecord&)>& follow);

/// The last step again, from a state whose dt is that of the step to come: for the forces, which belong to a step.
/// Throws SolverError when it fails. Collective.
SteadyRecord repeat_last_step(coupling::Problem& problem, coupling::State& state);

/// Forces of the flow on the nodes of the vessel's inside [N], [local node][4], in the step that `problem` last
/// accepted: the residual of the lumen elements, which is what acts on the wall in the coupled system, (5.3).
/// Collective.
std::vector<double> forces_on_wall(const coupling::Problem& problem);

}  // namespace tunica::stages
