#include "tunica/stages/run/simulation.hpp"

#include <fmt/format.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "session.hpp"
#include "solver.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/shared_error.hpp"
#include "tunica/quantities/quantity.hpp"

namespace tunica::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

using Functions = std::map<std::string, py::function>;

/// stages::Simulation with all that it needs to live, and functions of Python as its inflows.
class Simulation : Releasable {
 private:
  /// Runs `action` without the lock of the interpreter. What a function of Python has raised on its way is raised again
  /// on the rank that called it; on the others it is an error with its text.
  template <class Action>
  auto calling_back(const Action& action) {
    try {
      const py::gil_scoped_release released;
      return action();
    } catch (const parallel::SharedError&) {
      if (!raised_) throw;
      const py::error_already_set again = *raised_;
      raised_.reset();
      throw again;
    }
  }

 public:
  Simulation(const std::string& yaml, const fs::path& file, const py::object& comm,
             const std::optional<fs::path>& directory, bool restart, const std::optional<fs::path>& restart_file,
             bool overwrite, const std::optional<std::int64_t>& until, const Functions& inflows, bool verbose)
      : comm_(std::make_unique<OwnComm>(comm)) {
    std::vector<std::pair<std::string, coupling::Course>> courses;
    for (const auto& [face, function] : inflows) courses.emplace_back(face, course_of(face, function));
    stages::RunRequest request;
    request.case_file = file;
    request.case_text = yaml;
    request.directory = directory;
    request.restart = restart;
    request.restart_file = restart_file;
    request.overwrite = overwrite;
    request.until = until;
    request.program = program();
    const py::gil_scoped_release released;
    case_ = stages::read_case(*comm_, file, yaml);
    case_.inflows = std::move(courses);
    run_ = std::make_unique<stages::Simulation>(case_, request, *comm_, verbose ? stdout : nullptr);
  }
  ~Simulation() override { release(); }

  void release() override {
    run_.reset();
    case_ = stages::ReadCase();
    comm_.reset();
  }

  stages::Simulation& run() const {
    if (!run_) throw InputError("simulation", "has ended with MPI and PETSc", "use it before the interpreter ends");
    return *run_;
  }
  const stages::ReadCase& read() const { return case_; }

  bool step() {
    return calling_back([&] { return run().step(); });
  }
  void finish() {
    calling_back([&] { return run().finish().steps; });
  }
  fs::path checkpoint() {
    const py::gil_scoped_release released;
    return run().checkpoint();
  }

 private:
  /// Called on rank 0 alone, so that all ranks have the same.
  coupling::Course course_of(const std::string& face, const py::function& function) {
    const std::shared_ptr<py::function> held(new py::function(function), [](py::function* object) {
      const py::gil_scoped_acquire lock;
      delete object;
    });
    return [this, face, held](double t) {
      double flow = parallel::on_root(*comm_, [&] { return call(face, *held, t); });
      parallel::broadcast(*comm_, flow);
      return flow;
    };
  }

  /// Ctrl-C while the function is at work shall not spoil the step: it comes once the step is done.
  static py::object call_through_interrupt(const py::function& function, double t) {
    try {
      return function(t);
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_KeyboardInterrupt)) throw;
    }
    const py::object value = function(t);
    PyErr_SetInterrupt();
    return value;
  }

  double call(const std::string& face, const py::function& function, double t) {
    const py::gil_scoped_acquire lock;
    const std::string remedy = "return a number: the flow into the lumen in m^3/s (1 ml/s is 1e-6 m^3/s)";
    try {
      const py::object value = call_through_interrupt(function, t);
      const double flow = PyFloat_AsDouble(value.ptr());
      if (PyErr_Occurred() != nullptr) throw py::error_already_set();
      if (!std::isfinite(flow))
        throw InputError("inflow of " + face, fmt::format("is {} at t = {:.9g} s", flow, t), remedy);
      return flow;
    } catch (const py::error_already_set& error) {
      raised_ = error;
      throw;
    }
  }

  std::unique_ptr<OwnComm> comm_;
  std::optional<py::error_already_set> raised_;
  stages::ReadCase case_;
  std::unique_ptr<stages::Simulation> run_;  ///< refers to all of these
};

py::dict face_values(const stages::Simulation& run) {
  const auto& last = run.last();
  py::dict faces;
  for (const auto& face : last.faces_at_end ? *last.faces_at_end : last.record.faces) {
    py::dict values;
    values["flow"] = face.flow;
    values["pressure"] = face.mean_pressure;
    values["area"] = face.area;
    faces[py::str(face.name)] = values;
  }
  return faces;
}

py::tuple tuple_of(const Vec3<double>& v) { return py::make_tuple(v[0], v[1], v[2]); }

/// What a step has brought, by name; SI units.
py::dict step_values(const Simulation& simulation) {
  const auto& run = simulation.run();
  const auto& last = run.last();
  const auto& record = last.record;
  py::dict values;
  values["number"] = run.steps();
  values["time"] = last.time;
  values["dt"] = last.dt;
  values["evaluated"] = last.evaluated;
  values["newton_iterations"] = last.report.iterations.size();
  values["linear_iterations"] = last.report.linear_iterations();
  values["residual"] = last.report.final_norm;
  values["seconds"] = last.report.timings.total;
  values["faces"] = face_values(run);
  values["lumen_volume"] = record.lumen_volume;
  values["wall_volume"] = record.wall_volume;
  values["max_velocity"] = record.max_velocity;
  values["max_displacement"] = record.max_displacement;
  py::dict points;
  const auto& places = simulation.read().settings.output.points;
  for (std::size_t k = 0; k < last.points.size(); ++k) {
    const auto& p = last.points[k];
    py::dict point;
    point["displacement"] = tuple_of(p.displacement);
    point["velocity"] = tuple_of(p.velocity);
    point["pressure"] = p.pressure;
    points[py::str(places.at(k).first)] = point;
  }
  values["points"] = points;
  return values;
}

/// The first three numbers of each node's four, or the fourth.
py::array vectors(const std::vector<double>& field, const py::object& owner) {
  return view(field.data(), {static_cast<py::ssize_t>(field.size() / 4), 3}, {4, 1}, owner);
}
py::array fourths(const std::vector<double>& field, const py::object& owner) {
  return view(field.data() + (field.empty() ? 0 : 3), {static_cast<py::ssize_t>(field.size() / 4)}, {4}, owner);
}

py::array field(const py::object& self, const std::string& name) {
  const auto& simulation = self.cast<const Simulation&>();
  const coupling::State& state = simulation.run().state();
  if (name == "velocity") return vectors(state.velocity_pressure, self);
  if (name == "pressure") return fourths(state.velocity_pressure, self);
  if (name == "displacement") return vectors(state.displacement, self);
  if (name == "acceleration") return vectors(state.acceleration, self);
  if (name == "end_pressure")
    return view(state.end_pressure.data(), {static_cast<py::ssize_t>(state.end_pressure.size())}, {1}, self);
  throw InputError("field " + name, "is none of a simulation",
                   "name one of: velocity, pressure, end_pressure, displacement, acceleration");
}

/// A copy: (entries, columns), or (entries,) of a single column. Collective.
py::array quantity(const Simulation& simulation, const std::string& key, const std::string& region) {
  auto table = [&] {
    const py::gil_scoped_release released;
    return simulation.run().quantity(key, region);
  }();
  const auto rows = static_cast<py::ssize_t>(table.columns > 0 ? table.values.size() / table.columns : 0),
             columns = static_cast<py::ssize_t>(table.columns);
  if (columns == 1) return py::array_t<double>(rows, table.values.data());
  return py::array_t<double>({rows, columns}, table.values.data());
}

/// What there is to ask for: key, name in results, help, components.
py::list all_quantities() {
  py::list all;
  for (const auto& q : quantities::registry()) all.append(py::make_tuple(q.key, q.name, q.help, q.components));
  return all;
}

py::array points(const py::object& self) {
  return rows<double>(self.cast<const Simulation&>().run().mesh().points, self);
}

/// Of each node of this process, its number in the mesh as it was read.
py::array original_ids(const py::object& self) {
  const auto& ids = self.cast<const Simulation&>().run().mesh().original_ids;
  return view(ids.data(), {static_cast<py::ssize_t>(ids.size())}, {1}, self);
}

/// Corners (elements, 4) of the elements of a region that this process counts.
py::array elements(const py::object& self, const std::string& name) {
  std::string names;
  for (const auto& region : self.cast<const Simulation&>().run().mesh().regions) {
    if (region.name == name)
      return view(region.elements.empty() ? nullptr : region.elements.front().data(),
                  {static_cast<py::ssize_t>(region.owned_elements), 4}, {4, 1}, self);
    names += (names.empty() ? "" : ", ") + region.name;
  }
  throw InputError("region " + name, "the mesh has no region of this name", "name one of: " + names);
}

py::dict outlet(const Simulation& simulation, const std::string& face) {
  const auto model = simulation.run().outlet(face);
  py::dict values;
  if (const auto* rcr = std::get_if<bc::Rcr>(&model)) {
    values["proximal"] = rcr->proximal;
    values["capacitance"] = rcr->capacitance;
    values["distal"] = rcr->distal;
    values["distal_pressure"] = rcr->distal_pressure;
  } else {
    const auto& resistance = std::get<bc::Resistance>(model);
    values["resistance"] = resistance.resistance;
    values["distal_pressure"] = resistance.distal_pressure;
  }
  return values;
}

/// `yaml`: what the case file has for the face, {rcr: {...}} or {resistance: {...}}.
void set_outlet(const Simulation& simulation, const std::string& face, const std::string& yaml) {
  const auto condition =
      config::parse_text(bc::condition_schema(), yaml, {.name = "outlet " + face, .folder = "."}).value;
  if (const auto* rcr = std::get_if<bc::Rcr>(&condition)) return simulation.run().set_outlet(face, *rcr);
  if (const auto* resistance = std::get_if<bc::Resistance>(&condition))
    return simulation.run().set_outlet(face, *resistance);
  throw InputError("outlet " + face, "is given a condition that is no outlet", "give rcr or resistance");
}

/// Flow [m^3/s] and pressures [Pa] of the outlets at the end of the last step.
py::dict outlet_states(const Simulation& simulation) {
  py::dict states;
  for (const auto& outlet : simulation.run().state().outlets) {
    py::dict values;
    values["flow"] = outlet.flow();
    values["pressure"] = outlet.pressure();
    values["stored_pressure"] = outlet.stored_pressure();
    states[py::str(outlet.face())] = values;
  }
  return states;
}

py::list regions(const Simulation& simulation) {
  py::list names;
  for (const auto& region : simulation.run().mesh().regions) names.append(region.name);
  return names;
}

}  // namespace

void bind_simulation(py::module_& m) {
  m.def("quantities", all_quantities);
  py::class_<Simulation>(m, "Simulation")
      .def(py::init<const std::string&, const fs::path&, const py::object&, const std::optional<fs::path>&, bool,
                    const std::optional<fs::path>&, bool, const std::optional<std::int64_t>&, const Functions&, bool>())
      .def("step", &Simulation::step)
      .def("finish", &Simulation::finish)
      .def("checkpoint", &Simulation::checkpoint)
      .def("values", step_values)
      .def("field", field)
      .def("quantity", quantity)
      .def("elements", elements)
      .def("outlet", outlet)
      .def("set_outlet", set_outlet)
      .def("outlet_states", outlet_states)
      .def_property_readonly("points", points)
      .def_property_readonly("original_ids", original_ids)
      .def_property_readonly("regions", regions)
      .def_property_readonly("owned_nodes", [](const Simulation& s) { return s.run().mesh().owned_nodes; })
      .def_property_readonly("finished", [](const Simulation& s) { return s.run().finished(); })
      .def_property_readonly("steps", [](const Simulation& s) { return s.run().steps(); })
      .def_property_readonly("steps_asked", [](const Simulation& s) { return s.run().steps_asked(); })
      .def_property_readonly("time", [](const Simulation& s) { return s.run().time(); })
      .def_property_readonly("folder", [](const Simulation& s) { return s.run().folder(); })
      .def_property_readonly("warnings", [](const Simulation& s) {
        auto lines = s.read().warnings;
        lines.insert(lines.end(), s.read().mesh.warnings.begin(), s.read().mesh.warnings.end());
        return lines;
      });
}

}  // namespace tunica::python
