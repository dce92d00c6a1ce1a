#include <mpi.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "session.hpp"
#include "solver.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/pipeline/follow_up.hpp"
#include "tunica/pipeline/identify.hpp"
#include "tunica/pipeline/what_if.hpp"
#include "tunica/stages/measure/measure.hpp"
#include "tunica/stages/motion/motion.hpp"

namespace tunica::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

using Output = std::optional<fs::path>;

files::Say say_on_root(MPI_Comm comm, bool verbose) {
  return [speaks = verbose && parallel::rank(comm) == 0](const std::string& line) {
    if (!speaks) return;
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
}

/// Where pipelines print; nowhere unless it is verbose.
class Screen {
 public:
  explicit Screen(bool verbose) : file_(verbose ? stdout : std::fopen("/dev/null", "w")) {}
  ~Screen() {
    if (file_ && file_ != stdout) std::fclose(file_);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  operator std::FILE*() const { return file_ ? file_ : stdout; }

 private:
  std::FILE* file_;
};

/// Returns the folder of its results, as the next one.
fs::path measure(const fs::path& file, const Output& output, bool overwrite, const py::object& comm, bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  auto c = parallel::agree(own, [&] { return stages::read_measure_case(file).value; });
  if (output) c.output = *output;
  parallel::on_root(own, [&] { stages::measure(c, overwrite, say_on_root(own, verbose)); });
  return c.output;
}

fs::path motion(const fs::path& file, const Output& output, bool overwrite, const py::object& comm, bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  auto c = parallel::agree(own, [&] { return stages::read_motion_case(file).value; });
  if (output) c.output = *output;
  stages::motion(c, overwrite, own, say_on_root(own, verbose));
  return c.output;
}

/// Returns the signal that stopped it, 0: none; as the next one.
int follow_up(const fs::path& file, const Output& output, bool run, const py::object& comm, bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  const parallel::StopSignals signals;
  return pipeline::follow_up({.file = file, .output = output, .run = run, .program = program()}, own, Screen(verbose));
}

int what_if(const fs::path& file, const Output& output, const py::object& comm, bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  const parallel::StopSignals signals;
  return pipeline::what_if({.file = file, .output = output, .program = program()}, own, Screen(verbose));
}

int identify(const fs::path& file, const Output& output, const py::object& comm, bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  const parallel::StopSignals signals;
  return pipeline::identify({.file = file, .output = output, .program = program()}, own, Screen(verbose)).signal;
}

}  // namespace

void bind_patient(py::module_& m) {
  m.def("measure", measure);
  m.def("motion", motion);
  m.def("follow_up", follow_up);
  m.def("what_if", what_if);
  m.def("identify", identify);
}

}  // namespace tunica::python
