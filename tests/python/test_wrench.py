"""Force and moment of contact patches: against the laws, in arrays, and what is refused."""

import contensou as ct
import numpy as np
import pytest

PATCH = (0.2, 3e-3, 1e-4)
MOTIONS = np.random.default_rng(3).normal(size=(4, 5, 3)) * (1, 1, 400)
half = ct.law(lambda sliding, pivoting: (sliding / np.hypot(sliding, pivoting), 0.5 * pivoting / np.hypot(sliding, pivoting)), name="half")


@pytest.mark.parametrize("law", ["exact", "uniform", "elliptic", "elliptic:0.6", "pade", "punch", "pressure:0.5", half])
def test_the_wrench_is_that_of_the_law(law):
    friction, radius, creep = PATCH
    speed, rim = np.sqrt(np.sum(MOTIONS[..., :2] ** 2, axis=-1) + creep**2), radius * np.abs(MOTIONS[..., 2])
    force, moment = ct.law(law)(speed / rim)
    limit = friction * 1.7
    wrench = ct.wrench(law, MOTIONS, 1.7, PATCH)
    assert np.allclose(wrench[..., :2], -limit * (force / speed)[..., np.newaxis] * MOTIONS[..., :2], rtol=2e-15, atol=0)
    assert np.allclose(wrench[..., 2], -limit * radius * moment * np.sign(MOTIONS[..., 2]), rtol=2e-15, atol=0)
    value, slopes = ct.wrench(law, MOTIONS, 1.7, PATCH, slopes=True)
    assert np.array_equal(value, wrench)
    for axis, step in enumerate((1e-6, 1e-6, 1e-4)):
        moved = [ct.wrench(law, MOTIONS + sign * step * np.eye(3)[axis], 1.7, PATCH) for sign in (1, -1)]
        assert np.allclose((moved[0] - moved[1]) / (2 * step), slopes[..., axis], rtol=1e-5, atol=1e-9)


def test_one_contact_and_many():
    one = ct.wrench("exact", (1, 0, 100), 1.7, PATCH)
    assert one.shape == (3,) and one[1] == 0 and one[0] < 0 and one[2] < 0
    loads, frictions = np.array([1.7, 3.4, -1.0]), np.array([[0.2], [0.1]])
    many = ct.wrench("exact", (1, 0, 100), loads, (frictions, 3e-3, 1e-4))
    assert many.shape == (2, 3, 3)
    assert np.array_equal(many[0, 0], one) and np.array_equal(many[1, 1], one) and not many[:, 2].any()
    values, slopes = ct.wrench("exact", MOTIONS, np.ones((4, 1)), [0.2, np.full(5, 3e-3), 1e-4], slopes=True)
    assert values.shape == (4, 5, 3) and slopes.shape == (4, 5, 3, 3)
    assert np.array_equal(values[2, 3], ct.wrench("exact", MOTIONS[2, 3], 1, PATCH))
    assert np.array_equal(slopes[2, 3], ct.wrench("exact", MOTIONS[2, 3], 1, PATCH, slopes=True)[1])
    assert ct.wrench("exact", np.empty((0, 3)), 1, PATCH).shape == (0, 3)


def test_an_entry_that_is_not_a_number():
    loads = np.ma.array([1.0, 2.0, 3.0], mask=[False, True, False])
    value, slopes = ct.wrench("uniform", (1, 2, 3), loads, PATCH, slopes=True)
    assert np.isnan(value).all(axis=1).tolist() == np.isnan(slopes).all(axis=(1, 2)).tolist() == [False, True, False]


@pytest.mark.parametrize("motion, load, patch, slopes, error, words", [
    ((1, 2), 1, PATCH, False, ValueError, r"motion: vx, vy, omega along the last axis are needed; got an array of shape \(2,\)"),
    (1, 1, PATCH, False, ValueError, r"motion: .* shape \(\)"),
    ((1, 2, 3), 1, (0.2, 3e-3), False, TypeError, r"patch: \(friction, radius, creep\) is needed; got \(0.2"),
    ((1, 2, 3), [1, 2], (0.2, [1, 2, 3], 1e-4), False, ValueError, r"shapes that broadcast are needed; got motion of \(\)"),
    ((1, 2, 3), "1", PATCH, False, TypeError, "load: real numbers are needed"),
    ((1, 2, 3), 1, PATCH, 1, TypeError, "slopes: True or False is needed"),
    ((1, 2, 3), 1, ([0.2, -0.2], 3e-3, 1e-4), False, ValueError, "contact 1: friction must be >= 0"),
    ((1, 2, np.inf), 1, PATCH, False, ValueError, "contact 0: speeds must be finite"),
    ((1, 2, 3), 1, (0.2, 3e-3, 0), False, ValueError, "contact 0: the creep speed must be positive")])
def test_what_is_refused(motion, load, patch, slopes, error, words):
    with pytest.raises(error, match=words):
        ct.wrench("exact", motion, load, patch, slopes=slopes)


@pytest.mark.parametrize("law", ["exact", "uniform", "soft:3", half])
def test_one_contact_of_any_type_is_that_of_an_array(law):
    for motion in ((1, 0.5, -100), [1.0, np.float64(0.5), -100], np.array([1, 0.5, -100]), np.array([1, 7, 0.5, 7, -100])[::2], np.array([1, 0.5, -100])[::-1][::-1]):
        for load in (2, 1.7, np.float64(1.7), 0, -1.0):
            one, many = (ct.wrench(law, each, load, PATCH, slopes=True) for each in (motion, [motion]))
            assert all(a.shape == b.shape[1:] and a.dtype == b.dtype and np.array_equal(a, b[0]) for a, b in zip(one, many, strict=True))
            assert np.array_equal(ct.wrench(law, motion, load, list(PATCH)), one[0])
            step, steps = (ct.step(law, each, load, PATCH[:2], 20, 2e4, 0.01) for each in (motion, [motion]))
            assert all(np.array_equal(a, b[0]) for a, b in zip(step, steps, strict=True))
    assert ct.wrench(law, np.float32([1, 0.5, -100]), 1, PATCH).dtype == np.float32
    assert np.isnan(ct.wrench(law, (1, np.nan, 3), 1, PATCH)).all() and np.isnan(ct.step(law, (1, 2, 3), np.nan, PATCH[:2], 1, 1, 1)).all()
    for motion, load, words in (((1, 2, 3), 10**400, "load: numbers up to"), ((1, 2, 3, 4), 1, "motion: vx, vy, omega"), ((1, 2, np.inf), 1, "contact 0")):
        with pytest.raises(ValueError, match=words):
            ct.wrench(law, motion, load, PATCH)
