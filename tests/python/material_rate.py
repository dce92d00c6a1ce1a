"""Rates to hold against benchmark_material_batch: the same laws, as many points, by Python. Time of the processor."""
import time

import numpy as np
from tunica import materials


def seconds(action, repetitions=5):
    best = np.inf
    for _ in range(repetitions):
        start = time.process_time()
        action()
        best = min(best, time.process_time() - start)
    return best


def main(points=1_000_000):
    F = np.eye(3) + np.random.default_rng(1).uniform(-0.05, 0.05, (points, 3, 3))
    memory = np.empty((points, 3, 3)), np.empty((points, 6, 6))
    laws = {"neo_hooke": materials.neo_hooke(shear_modulus="30 kPa", bulk_modulus="1 MPa"),
            "dfd": materials.aortic_tissue("flap")}
    for name, law in laws.items():
        kept = seconds(lambda: law.response(F, out=memory))
        anew = seconds(lambda: law.response(F))
        print(f"{name:12} {1e-6 * points / kept:8.2f} million points/s, into new memory {1e-6 * points / anew:8.2f}")


if __name__ == "__main__":
    main()
