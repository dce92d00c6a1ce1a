"""What importing the package leaves alone: signal handlers of the process, and MPI where a program has it."""
import subprocess
import sys
import unittest

PROBE = """
import signal, sys
{before}
handlers = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1, signal.SIGHUP, signal.SIGSEGV)]
import numpy as np, tunica
law = tunica.materials.neo_hooke(young_modulus="1 MPa", poisson_ratio=0.3)
law.stress(np.eye(3))
after = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1, signal.SIGHUP, signal.SIGSEGV)]
assert handlers == after, (handlers, after)
{after}
print("fine")
"""


def probe(before="", after="", **options):
    return subprocess.run([sys.executable, "-c", PROBE.format(before=before, after=after)], capture_output=True,
                          text=True, **options)


class Process(unittest.TestCase):
    def test_signal_handlers_stay(self):
        done = probe()
        self.assertEqual(done.stdout.strip(), "fine", done.stderr)

    def test_import_does_not_start_mpi(self):
        done = probe(after="""
import ctypes
flag = ctypes.c_int(7)
try:
    ctypes.CDLL("libmpi.so.40").MPI_Initialized(ctypes.byref(flag))
except OSError:
    flag.value = 0
assert flag.value == 0""")
        self.assertEqual(done.stdout.strip(), "fine", done.stderr)

    def test_beside_mpi4py(self):
        if subprocess.run([sys.executable, "-c", "import mpi4py"], capture_output=True).returncode:
            self.skipTest("mpi4py is not there")
        done = probe(before="from mpi4py import MPI\nassert MPI.COMM_WORLD.allreduce(1) == 1",
                     after="assert MPI.COMM_WORLD.allreduce(1) == 1")
        self.assertEqual(done.stdout.strip(), "fine", done.stderr)

    def test_ctrl_c_ends_a_long_evaluation(self):
        text = """
import numpy as np, os, signal, threading, tunica
law = tunica.materials.aortic_tissue("flap")
F = np.broadcast_to(np.eye(3), (3_000_000, 3, 3))
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    for _ in range(100): law.stress(F)
except KeyboardInterrupt:
    print("interrupted")
"""
        done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.stdout.strip(), "interrupted", done.stderr)


if __name__ == "__main__":
    unittest.main()
