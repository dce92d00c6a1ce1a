#include <mpi.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "session.hpp"
#include "solver.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/stages/post/post.hpp"
#include "tunica/stages/prestress/prestress.hpp"
#include "tunica/stages/run/run.hpp"
#include "tunica/stages/tuning/tune.hpp"

namespace tunica::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

std::FILE* screen(bool verbose) { return verbose ? stdout : nullptr; }

/// Each returns the signal that stopped it, 0: none.
int prestress(const std::string& yaml, const fs::path& file, const fs::path& folder, bool overwrite, bool keep_flow,
              const py::object& comm, bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  const parallel::StopSignals signals;
  return stages::prestress(own,
                           {.case_file = file,
                            .case_text = yaml,
                            .directory = folder,
                            .overwrite = overwrite,
                            .keep_flow = keep_flow,
                            .program = program()},
                           screen(verbose));
}

int tune(const std::string& yaml, const fs::path& file, const fs::path& folder, bool overwrite, const py::object& comm,
         bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  const parallel::StopSignals signals;
  return stages::tune(own,
                      {.case_file = file,
                       .case_text = yaml,
                       .directory = folder,
                       .overwrite = overwrite,
                       .program = program(),
                       .run_case = stages::run_case},
                      screen(verbose));
}

void cycle_quantities(const std::string& yaml, const fs::path& file, const fs::path& results, const fs::path& folder,
                      bool overwrite, const py::object& comm, bool verbose) {
  const OwnComm own(comm);
  const py::gil_scoped_release released;
  stages::post::post_results(own,
                             {.case_file = file,
                              .case_text = yaml,
                              .results = results,
                              .output = folder,
                              .overwrite = overwrite,
                              .program = program()},
                             screen(verbose));
}

}  // namespace

void bind_stages(py::module_& m) {
  m.def("prestress", prestress);
  m.def("tune", tune);
  m.def("cycle_quantities", cycle_quantities);
}

}  // namespace tunica::python
