#include "session.hpp"

#include <memory>
#include <optional>
#include <set>

#include "commit.hpp"  // written by cmake/write_commit.cmake with every build
#include "tunica/base/error.hpp"
#include "tunica/parallel/launcher.hpp"
#include "tunica/parallel/message.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::python {

namespace py = pybind11;

namespace {

// MPI and PETSc are one for each process, and so is what stands for them here.
std::unique_ptr<parallel::Session> session;
std::set<Releasable*> holders;

void end_session() {
  while (!holders.empty()) {
    Releasable* holder = *holders.begin();
    holders.erase(holders.begin());
    holder->release();
  }
  session.reset();
}

void start_session() {
  if (session) return;
  session = std::make_unique<parallel::Session>();
  // Before the interpreter takes its modules apart, and before mpi4py ends MPI.
  py::module_::import("atexit").attr("register")(py::cpp_function(end_session));
  parallel::refuse_another_launcher(parallel::size(MPI_COMM_WORLD));
}

}  // namespace

OwnComm::OwnComm(const py::object& comm) {
  if (!comm.is_none() && !py::hasattr(comm, "py2f"))
    throw InputError("comm", "is " + std::string(py::repr(comm)),
                     "give a communicator of mpi4py, such as MPI.COMM_WORLD, or None for all processes");
  start_session();
  const MPI_Comm given = comm.is_none() ? MPI_COMM_WORLD : MPI_Comm_f2c(comm.attr("py2f")().cast<MPI_Fint>());
  MPI_Comm_dup(given, &comm_);
}

OwnComm::~OwnComm() {
  int ended = 0;
  MPI_Finalized(&ended);
  if (ended == 0 && comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
}

Releasable::Releasable() { holders.insert(this); }
Releasable::~Releasable() { holders.erase(this); }

artifacts::ProgramVersion program() { return {TUNICA_VERSION, TUNICA_COMMIT}; }

std::function<void(const std::string&)> speaker(const py::object& say) {
  // The reference is given back under the lock, wherever the last copy of the function goes.
  const std::shared_ptr<py::object> held(new py::object(say), [](py::object* object) {
    const py::gil_scoped_acquire lock;
    delete object;
  });
  return [held](const std::string& line) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!held->is_none()) (*held)(line);
  };
}

}  // namespace tunica::python
