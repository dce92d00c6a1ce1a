# Wall laws without a mesh: stress and stiffness of the media of a dissected aorta by laws with fibres and without, in the
# tests by which tissue is measured.
#
#   export PYTHONPATH=$PWD/build/release/python
#   /usr/bin/python3 examples/python/laws.py

# %%
import numpy as np
from tunica import materials

# %% Three laws. Values have units, as in a case file; `help(materials.hgo)` lists them
families = [{"k1": "34 kPa", "k2": 12.6, "mean_angle": angle} for angle in ("38 deg", "-38 deg")]
laws = {
    "neo-Hooke": materials.neo_hooke(shear_modulus="61 kPa", poisson_ratio=0.49),
    "HGO": materials.hgo(shear_modulus="61 kPa", poisson_ratio=0.49, families=families),
    "flap, dispersed fibres": materials.aortic_tissue("flap"),
}

# %% Equibiaxial stretch: what a biaxial machine does, second Piola-Kirchhoff stress along the first axis
for name, law in laws.items():
    test = law.biaxial(to=1.15, to_across=1.15, steps=30, along="e1", across="e2")
    S = test.stress("second_piola_kirchhoff")
    print(f"{name:24s} {S[10] / 1e3:7.1f} {S[20] / 1e3:7.1f} {S[-1] / 1e3:7.1f} kPa at stretches of 1.05, 1.10, 1.15")

# %% Many states at once: a thousand gradients, stretched around the vessel and along it by a third of that. The pressure
# across the wall is free, so stresses count from it
stretch = np.linspace(1, 1.15, 1000)
along = 1 + (stretch - 1) / 3
F = np.zeros((1000, 3, 3))
F[:, 0, 0], F[:, 1, 1], F[:, 2, 2] = stretch, along, 1 / (stretch * along)
for name, law in laws.items():
    sigma = law.stress(F)
    around, lengthwise = ((sigma[-1, i, i] - sigma[-1, 2, 2]) / 1e3 for i in (0, 1))
    print(f"{name:24s} {around:7.1f} kPa around the vessel, {lengthwise:7.1f} kPa along it")

# %% Curves, where matplotlib is installed
try:
    import matplotlib
except ImportError:
    matplotlib = None
if matplotlib:
    import matplotlib.pyplot as plt

    for name, law in laws.items():
        test = law.uniaxial(to=1.2, steps=40, along="e1")
        plt.plot(test.load, test.stress() / 1e3, label=name)
    plt.xlabel("stretch around the vessel")
    plt.ylabel("Cauchy stress [kPa]")
    plt.legend()
    plt.show()
