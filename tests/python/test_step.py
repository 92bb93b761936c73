"""Implicit steps of contact patches: against the friction at their end, against energy, in arrays, and what is refused."""

import contensou as ct
import numpy as np
import pytest

PATCH, MASS = (0.2, 3e-3), (20.0, 2e4)
MOTIONS = np.random.default_rng(3).normal(size=(40, 5, 3)) * (0.5, 0.5, 200)


@pytest.mark.parametrize("law", ["exact", "uniform", "elliptic:0.6", "pade", "punch", "pressure:0.5"])
def test_the_friction_of_a_step_is_that_at_its_end(law):
    after, means = ct.step(law, MOTIONS, 1.7, PATCH, *MASS, 0.05)
    np.testing.assert_allclose(after, MOTIONS + 0.05 * means * (MASS[0], MASS[0], MASS[1]), rtol=0, atol=1e-12)
    moves = after.any(axis=-1)
    assert moves.any()
    at_end = ct.wrench(law, after[moves], 1.7, (*PATCH, 1e-12))
    np.testing.assert_allclose(means[moves] / (1, 1, 3e-3), at_end / (1, 1, 3e-3), rtol=0, atol=1e-8)
    energy = np.sum(np.square([MOTIONS, after]) / (MASS[0], MASS[0], MASS[1]), axis=-1)
    assert (energy[1] <= energy[0] * (1 + 1e-15)).all()


def test_rest_and_broadcasting():
    after, means = ct.step("exact", [(0.05, 0, 0), (0.5, 0, 0)], 1.7, PATCH, *MASS, [[0.001], [0.01], [0.1]])
    assert after.shape == means.shape == (3, 2, 3)
    assert (after.any(axis=-1) == [[True, True], [False, True], [False, False]]).all()
    np.testing.assert_allclose(means[1, 0], (-0.05 / 20 / 0.01, 0, 0), rtol=1e-14)
    np.testing.assert_array_equal(after[2, 1], ct.step("exact", (0.5, 0, 0), 1.7, PATCH, *MASS, 0.1)[0])
    one = MOTIONS.copy()
    wanted = ct.step("exact", MOTIONS, 1.7, PATCH, *MASS, 0.01)[0]
    ct.step("exact", one, 1.7, PATCH, *MASS, 0.01, out=(one, np.empty_like(one)))
    np.testing.assert_array_equal(one, wanted)
    loads = np.ma.array([1.0, 2.0, -1.0], mask=[False, True, False])
    after, means = ct.step("uniform", (1, 2, 3), loads, PATCH, *MASS, 0.01)
    assert np.isnan(after).all(axis=1).tolist() == np.isnan(means).all(axis=1).tolist() == [False, True, False]
    assert after[2].tolist() == [1, 2, 3] and not means[2].any()


@pytest.mark.parametrize("motion, patch, mass, dt, error, words", [
    ((1, 2), PATCH, MASS, 1, ValueError, r"motion: vx, vy, omega along the last axis are needed"),
    ((1, 2, 3), (0.2, 3e-3, 1e-4), MASS, 1, TypeError, r"patch: \(friction, radius\) is needed; got \(0.2"),
    ((1, 2, 3), (0.2, [3e-3, -1]), MASS, 1, ValueError, "contact 1: the patch radius must be >= 0"),
    ((1, 2, 3), PATCH, (-1, 1), 1, ValueError, "contact 0: by_force and by_moment must be >= 0"),
    ((1, 2, 3), PATCH, MASS, [0.1, -0.1], ValueError, "contact 1: the time step must be >= 0"),
    ((1, np.inf, 3), PATCH, MASS, 1, ValueError, "contact 0: speeds must be finite")])
def test_what_is_refused(motion, patch, mass, dt, error, words):
    with pytest.raises(error, match=words):
        ct.step("exact", motion, 1, patch, *mass, dt)
