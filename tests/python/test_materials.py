"""Wall laws by Python: against closed forms, derivatives, the program's own messages, and their batch rate."""
import inspect
import unittest

import numpy as np
import tunica
from tunica import materials

EXAMPLES = {
    "neo_hooke": dict(young_modulus="1 MPa", poisson_ratio=0.45),
    "mooney_rivlin": dict(c1="20 kPa", c2="5 kPa", bulk_modulus="1 MPa"),
    "hgo": dict(shear_modulus="20 kPa", bulk_modulus="1 MPa",
                families=[{"k1": "30 kPa", "k2": 5, "mean_angle": "35 deg"},
                          {"k1": "30 kPa", "k2": 5, "mean_angle": "-35 deg"}]),
    "goh": dict(shear_modulus="20 kPa", bulk_modulus="1 MPa",
                families=[{"k1": "30 kPa", "k2": 5, "mean_angle": "35 deg", "kappa": 0.1}]),
    "dfd": dict(shear_modulus="20 kPa", bulk_modulus="1 MPa",
                families=[{"k1": "30 kPa", "k2": 5,
                           "von_mises": {"b": 2, "mean_angle": "35 deg"}}]),
    "fung": dict(c="10 kPa", bulk_modulus="1 MPa", b_cc=0.9, b_ll=0.6, b_rr=0.4, b_cl=0.2, b_lr=0.1, b_rc=0.1,
                 g_cl=0.3, g_lr=0.2, g_rc=0.2),
    "holzapfel_ogden": dict(a="0.5 kPa", b=8, a_f="18 kPa", b_f=16, a_s="2.5 kPa", b_s=11, a_fs="0.2 kPa", b_fs=11,
                            bulk_modulus="100 kPa"),
    "st_venant_kirchhoff": dict(young_modulus="1 MPa", poisson_ratio=0.3),
}


def some_gradients(count, size=0.1, seed=1):
    F = np.eye(3) + size * np.random.default_rng(seed).uniform(-1, 1, (count, 3, 3))
    return F[np.linalg.det(F) > 0.3]


def voigt(tensor):
    return np.stack([tensor[..., i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))], axis=-1)


class ClosedForms(unittest.TestCase):
    def test_uniaxial_incompressible_neo_hooke(self):
        law = materials.neo_hooke(shear_modulus="50 kPa", poisson_ratio=0.5)
        self.assertTrue(law.incompressible)
        test = law.uniaxial(to=1.5, steps=10)
        exact = 50e3 * (test.load**2 - 1 / test.load)
        np.testing.assert_allclose(test.stress(), exact, rtol=1e-9, atol=1e-6)
        np.testing.assert_allclose(test.stress("first_piola_kirchhoff"), exact / test.load, rtol=1e-9, atol=1e-6)

    def test_equibiaxial_incompressible_neo_hooke(self):
        test = materials.neo_hooke(shear_modulus=50e3, poisson_ratio=0.5).biaxial(to=1.3)
        np.testing.assert_allclose(test.stress(across=True), 50e3 * (test.load**2 - test.load**-4), rtol=1e-8, atol=1e-5)

    def test_simple_shear_of_compressible_neo_hooke(self):
        test = materials.neo_hooke(shear_modulus=50e3, poisson_ratio=0.3).simple_shear(to=0.5)
        np.testing.assert_allclose(test.stress(), 50e3 * test.load, rtol=1e-10, atol=1e-8)


class Derivatives(unittest.TestCase):
    """For every law of EXAMPLES: S = 2 dPsi/dC and CC = 2 dS/dC by differences, and the three stresses agree."""

    def test_examples_are_of_all_laws(self):
        self.assertEqual(set(EXAMPLES) | {"aortic_tissue", "fitted"}, set(materials.laws()))

    def test_all_laws(self):
        F = some_gradients(37, 0.1)
        C = np.swapaxes(F, 1, 2) @ F
        for name, parameters in EXAMPLES.items():
            with self.subTest(name):
                law = getattr(materials, name)(**parameters)
                S, CC = law.response(F)
                scale = np.abs(CC).max()
                step = 1e-6
                direction = np.random.default_rng(2).normal(size=(3, 3))
                direction = direction + direction.T

                def root(A):  # C = U U, and every law depends on C alone
                    values, vectors = np.linalg.eigh(A)
                    return (vectors * np.sqrt(values)[:, None, :]) @ np.swapaxes(vectors, 1, 2)

                ahead, behind = root(C + step * direction), root(C - step * direction)
                slope = (law.energy(ahead) - law.energy(behind)) / (2 * step)
                np.testing.assert_allclose(0.5 * np.einsum("nij,ij->n", S, direction), slope, atol=1e-7 * scale)
                change = (law.stress(ahead, "second_piola_kirchhoff") - law.stress(behind, "second_piola_kirchhoff")) / (
                    2 * step)
                weights = voigt(direction) * [1, 1, 1, 2, 2, 2]
                np.testing.assert_allclose(0.5 * np.einsum("nij,j->ni", CC, weights), voigt(change), atol=1e-6 * scale)
                J = np.linalg.det(F)[:, None, None]
                np.testing.assert_allclose(law.stress(F), F @ S @ np.swapaxes(F, 1, 2) / J, atol=1e-12 * scale)
                np.testing.assert_allclose(law.stress(F, "first_piola_kirchhoff"), F @ S, atol=1e-12 * scale)

    def test_rotation_of_the_body_turns_the_stress(self):
        law = materials.hgo(**EXAMPLES["hgo"])
        F = some_gradients(20)
        Q, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
        Q *= np.sign(np.linalg.det(Q))
        np.testing.assert_allclose(law.stress(Q @ F), Q @ law.stress(F) @ Q.T, rtol=1e-9, atol=1e-6)


class Arrays(unittest.TestCase):
    def test_every_count_gives_the_same_points(self):
        law = materials.dfd(**EXAMPLES["dfd"])
        F = some_gradients(40)
        S, CC = law.response(F)
        for count in (1, 2, 3, 7, 8, 9, 17):
            part, tangent = law.response(F[:count])
            np.testing.assert_array_equal(part, S[:count])
            np.testing.assert_array_equal(tangent, CC[:count])

    def test_shapes(self):
        law = materials.neo_hooke(**EXAMPLES["neo_hooke"])
        F = np.broadcast_to(np.eye(3), (4, 5, 3, 3))
        self.assertEqual(law.stress(F).shape, (4, 5, 3, 3))
        self.assertEqual(law.tangent(F).shape, (4, 5, 6, 6))
        self.assertEqual(law.energy(F).shape, (4, 5))
        self.assertEqual(law.energy(np.eye(3)), 0)
        self.assertEqual(law.stress(np.empty((0, 3, 3))).shape, (0, 3, 3))
        out = np.empty((4, 5, 3, 3))
        self.assertIs(law.stress(F, out=out), out)

    def test_pressure_of_an_incompressible_law(self):
        law = materials.neo_hooke(shear_modulus=50e3, poisson_ratio=0.5)
        F = np.diag([1.2, 1 / 1.2, 1.0])
        free = law.stress(F)
        np.testing.assert_allclose(law.stress(F, pressure=1e3), free - 1e3 * np.eye(3), rtol=1e-12)


class Messages(unittest.TestCase):
    def expect(self, text, call, *arguments, **named):
        with self.assertRaises(tunica.InputError) as caught:
            call(*arguments, **named)
        self.assertIn(text, str(caught.exception))
        self.assertTrue(all(len(problem) == 3 for problem in caught.exception.problems))
        return caught.exception

    def test_unit_of_another_dimension_and_unknown_key_at_once(self):
        error = self.expect("young_modulus", materials.neo_hooke, young_modulus="1 mm", stiffness=3)
        self.assertGreaterEqual(len(error.problems), 2)

    def test_inverted_gradient_is_named(self):
        F = np.stack([np.eye(3), -np.eye(3)])
        self.expect("number 1 has det F = -1", materials.neo_hooke(**EXAMPLES["neo_hooke"]).stress, F)

    def test_shape(self):
        self.expect("(3,)", materials.neo_hooke(**EXAMPLES["neo_hooke"]).stress, np.ones(3))

    def test_volume_of_an_incompressible_law(self):
        law = materials.neo_hooke(shear_modulus=50e3, poisson_ratio=0.5)
        self.expect("incompressible", law.stress, 1.1 * np.eye(3))

    def test_pressure_of_a_compressible_law(self):
        self.expect("bulk modulus", materials.neo_hooke(**EXAMPLES["neo_hooke"]).stress, np.eye(3), pressure=1.0)

    def test_out_of_another_shape(self):
        self.expect("out", materials.neo_hooke(**EXAMPLES["neo_hooke"]).stress, np.eye(3), out=np.empty((2, 3, 3)))

    def test_input_error_is_a_value_error(self):
        self.assertTrue(issubclass(tunica.InputError, ValueError))
        self.assertTrue(issubclass(tunica.SolverError, RuntimeError))


class Schema(unittest.TestCase):
    def test_help_tells_keys_units_and_ranges(self):
        text = materials.hgo.__doc__
        for part in ("shear_modulus [Pa]", "families", "k1 [Pa]", "mean_angle [rad]", "> 0"):
            self.assertIn(part, text)
        self.assertIn("families", inspect.signature(materials.hgo).parameters)

    def test_every_law_of_the_schema_is_there_and_in_the_stubs(self):
        import pathlib
        stubs = (pathlib.Path(materials.__file__).parent / "materials.pyi").read_text()
        for name in materials.laws():
            self.assertTrue(callable(getattr(materials, name)))
            self.assertIn(f"def {name}(", stubs)

    def test_numbers_are_si(self):
        a = materials.hgo(**EXAMPLES["hgo"])
        b = materials.hgo(shear_modulus=20e3, bulk_modulus=np.float64(1e6),
                          families=[{"k1": 30e3, "k2": 5, "mean_angle": np.radians(35)},
                                    {"k1": 30e3, "k2": 5, "mean_angle": -np.radians(35)}])
        F = some_gradients(5)
        np.testing.assert_allclose(a.stress(F), b.stress(F), rtol=1e-12)

    def test_yaml_makes_the_same_material(self):
        a = materials.goh(**EXAMPLES["goh"])
        F = some_gradients(5)
        np.testing.assert_array_equal(materials.from_yaml(a.yaml).stress(F), a.stress(F))

    def test_default_tissue(self):
        self.assertGreater(materials.aortic_tissue("flap").shear_modulus, 0)


if __name__ == "__main__":
    unittest.main()
