"""Symmetries of planar systems, and the motions that they solve, against SciPy and against what is known."""

import math
import random

import contensou as ct
import numpy as np
import pytest
from scipy.integrate import solve_ivp


def random_field(rng):
    """A homogeneous field of degree n < 1 whose orbits all come to the origin, and its polar form: p' = R, angle' = T."""
    n, inwards, turning = rng.uniform(-0.6, 0.5), rng.uniform(0.5, 2), rng.choice([0.0, rng.uniform(-3, 3)])
    swing, wave, shift, modes = rng.uniform(0, 0.8), rng.uniform(-1, 1), rng.uniform(0, 7), rng.choice([1, 2, 3])
    radial = lambda angle: -inwards * (1 + swing * math.cos(2 * angle + shift))
    angular = lambda angle: turning + wave * math.sin(modes * angle - shift)

    def field(u, v):
        size, angle = math.hypot(u, v), math.atan2(v, u)
        a, b = size**n * radial(angle), size**n * angular(angle)
        return a * math.cos(angle) - b * math.sin(angle), a * math.sin(angle) + b * math.cos(angle)

    return field, n, radial, angular


def test_200_random_homogeneous_fields_come_to_the_origin_when_scipy_says():
    rng = random.Random(27)
    worst = 0.0
    for _ in range(200):
        field, n, radial, angular = random_field(rng)
        angle = rng.uniform(-3, 3)
        reduction = ct.reduce(field, u=math.cos(angle), v=math.sin(angle))
        assert reduction.generator.time == pytest.approx((1 - n) * reduction.generator.matrix[0, 0], abs=1e-12)
        c, size = 1 - n, rng.uniform(0.1, 10)
        # In ln r and the angle, with sigma for time: steps until what is left is nothing.
        motion = lambda sigma, y: (radial(y[1]), angular(y[1]), math.exp(c * y[0]))
        arrived = lambda sigma, y: c * y[0] + 32
        arrived.terminal = True
        solved = solve_ivp(motion, (0, 1e4), (0.0, angle, 0.0), method="DOP853", rtol=1e-12, atol=1e-13, events=arrived)
        time = solved.y[2, -1] * size**c
        got = reduction.stop_time(u=size * math.cos(angle), v=size * math.sin(angle))
        worst = max(worst, abs(got / time - 1))
    assert worst < 1e-9, worst


def test_a_function_and_its_formulas_are_one_system():
    a = 0.2
    function = ct.reduce(lambda u, v: (-u / math.hypot(u, v), -v / math.hypot(u, v) - a), u=1, v=1)
    text = ct.reduce("u' = -u/hypot(u, v); v' = -v/hypot(u, v) - a", u=1, v=1, a=a)
    assert function.kind == text.kind == "stable node"
    assert [ray.attracts for ray in text.rays] == [True, False]
    u, v = np.array([[1.0, -0.3], [0, 2]]), 1.5
    assert text.stop_time(u=u, v=v).shape == (2, 2)
    np.testing.assert_allclose(text.stop_time(u=u, v=v), function.stop_time(u=u, v=v), rtol=1e-13)
    assert text.stop_time(u=0, v=1) == pytest.approx(1 / 1.2, rel=1e-13)
    us, vs = text.at([0.1, 0.5], u=1, v=1)
    integral = text.first_integral(us, vs)
    np.testing.assert_allclose(integral, text.first_integral(1, 1), atol=1e-11)
    assert math.isnan(text.first_integral(0, 1))  # a ray
    assert "stable node" in repr(text)


def test_zhuravlev_s_system():
    flow = ct.Flow(mu=0.3)
    reduction = flow.reduction()
    generator = reduction.generator
    assert (generator.time, generator.matrix.tolist(), generator.shift.tolist()) == (1, [[1, 0], [0, 1]], [0, 0])
    assert reduction.gap > 1e6 and len(reduction.singular_values) == 7
    q, p = reduction.canonical([1, -2], 4)
    assert q.tolist() == [4, -2] and p.tolist() == [math.log(4)] * 2
    states = flow.orbit(u=1, v=1).at([0, 1, 5])
    np.testing.assert_allclose(reduction.first_integral(states["u"], states["v"]), reduction.first_integral(1, 1), atol=1e-12)
    u, v = np.array([1.0, 1e-3, 0, 5]), np.array([1.0, 2, 1, 0])
    np.testing.assert_allclose(reduction.stop_time(u=u, v=v), flow.stop_time(u=u, v=v), rtol=1e-12)
    facts = flow.facts()
    assert len(facts) == 4 and {point.place for point in facts} == {"origin", "infinity"}
    assert {point.kind for point in facts} == {"saddle", "stable node", "unstable node"}


def test_no_symmetry_and_no_values():
    drag = ct.reduce(lambda u, v: (-u, -v / math.hypot(u, v)), u=1, v=1)
    assert drag.verdict == "none" and drag.generators == () and not drag.solved
    with pytest.raises(ValueError, match="the verdict is none"):
        drag.generator
    with pytest.raises(ValueError, match="not solved"):
        drag.stop_time(u=1, v=1)
    with pytest.raises(ValueError, match="0 of 128 points.*division by zero"):
        ct.reduce(lambda u, v: (1 / 0, 0), u=1, v=1)
    with pytest.raises(TypeError, match="pair of numbers"):
        ct.reduce(lambda u, v: 3, u=1, v=1)
    with pytest.raises(ValueError, match="did you mean 'hypot'"):
        ct.reduce("u' = hypt(u, v); v' = 1", u=1, v=1)
    with pytest.raises(TypeError, match="has its parameters itself, got a"):
        ct.reduce(lambda u, v: (1, 1), u=1, v=1, a=2)
    calls = []

    def stopped(u, v):
        calls.append(u)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ct.reduce(stopped, u=1, v=1)
    assert len(calls) == 1


def test_noise_is_not_taken_for_structure():
    rng = random.Random(1)
    noisy = lambda size: lambda u, v: (-u / math.hypot(u, v) + rng.gauss(0, size), -v / math.hypot(u, v) + rng.gauss(0, size))
    assert ct.reduce(noisy(1e-9), u=1, v=1).generator.time == pytest.approx(1, abs=1e-6)
    assert ct.reduce(noisy(0.1), u=1, v=1).verdict == "undecided"
