// Stopping a run in good order.
#pragma once

#include <mpi.h>

#include <csignal>

namespace tunica::parallel {

/// While it lives, SIGINT, SIGTERM, SIGUSR1 and SIGHUP (the terminal is gone) ask the run to stop at the next place
/// where it can be continued, and a second one ends the process at once. A signal within half a second after the first
/// is taken for the same request, since launchers pass on what the terminal delivers as well; so is SIGHUP at any time,
/// which shell and kernel both send. A SIGHUP that is ignored, as under nohup, stays so. Earlier handlers return with
/// its end. One within
/// another does nothing.
///
/// Open MPI's mpirun turns SIGINT and SIGTERM into SIGTERM and, one second later, SIGKILL. It passes SIGUSR1 on
/// unchanged, and `mpirun --mca odls_base_sigkill_timeout <seconds>` gives longer for the others (some
/// ten seconds; after that mpirun itself gives up).
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

 private:
  struct sigaction earlier_[4];
};

/// The signal that asked any rank to stop since the StopSignals began, 0 when there was none (the largest number when
/// there were several); same answer on all ranks. Collective.
int stop_requested(MPI_Comm comm);

}  // namespace tunica::parallel
