"""Laws, stop times and orbits, against SciPy and against the equations themselves."""

import copy
import math
import pickle
import threading

import contensou as ct
import numpy as np
import pytest
from scipy.integrate import solve_ivp

LAWS = ["exact", "pade", "uniform", "punch", "ring", "pressure:1.5", "elliptic", "paraboloid", "annulus:0.5", "soft:4", "elliptic:0.7"]


def by_scipy(law, mu, u, v, chi=3.5, gamma=2.5):
    """Returns the stop time of (2.6), in ln u and ln v, by SciPy, until only pivoting is left. The rest of the time is known."""

    def rate(time, state):
        force, moment = law(math.exp(state[1] - state[0]) / mu)
        return [-2 * gamma * mu / (3 * math.pi) * moment / math.exp(state[0]),
                -2 * chi / (3 * math.pi) * force / math.exp(state[1])]

    stopped = lambda time, state: min(state[1] - state[0] - math.log(mu) + 16, max(state) + 23)
    stopped.terminal = True
    run = solve_ivp(rate, (0, 1e6), [math.log(u), math.log(v)], method="LSODA", events=stopped, rtol=1e-10, atol=1e-10)
    assert run.t_events[0].size == 1
    left = math.exp(run.y_events[0][0][0])
    return run.t_events[0][0] + left * 3 * math.pi / (2 * gamma * mu * law.pivoting_moment)


def test_a_stop_time_against_solve_ivp():
    assert ct.stop_time(u=1, v=0.3, mu=1, law="exact") == pytest.approx(by_scipy(ct.law("exact"), 1, 1, 0.3), rel=1e-7)


@pytest.mark.parametrize("name", LAWS)
def test_a_law_is_known_by_its_name(name):
    assert ct.law(name).name == name
    assert ct.stop_time(u=1, v=1, mu=0.1, law=name) == ct.Flow(mu=0.1, law=ct.law(name)).stop_time(u=1, v=1)
    assert name == "exact" or ct.stop_time(u=1, v=1, mu=0.1, law=name) != ct.stop_time(u=1, v=1, mu=0.1)


def test_gradients_are_of_each_entry():
    u, v = np.array([1.0, -30.0, 0.01]), np.array([1.0, 2.0, 5.0])
    tau, by = ct.stop_time(u=u, v=v, mu=0.2, gradient=True)
    np.testing.assert_array_equal(tau, ct.stop_time(u=u, v=v, mu=0.2))
    np.testing.assert_allclose(u * by["u"] + v * by["v"], tau, rtol=1e-12)
    more, less = (ct.stop_time(u=u, v=v, mu=0.2 * (1 + step)) for step in (1e-4, -1e-4))
    np.testing.assert_allclose(0.2 * by["mu"], (more - less) / 2e-4, rtol=1e-6)
    # A mu of its own in each row, and entries without a gradient.
    mus, each = ct.stop_time(u=u, v=v, mu=np.array([0.2, 0.3, 0.2]), gradient=True)
    assert each["mu"][[0, 2]] == pytest.approx(by["mu"][[0, 2]], rel=1e-14) and each["mu"][1] != by["mu"][1]
    tau, by = ct.stop_time(u=[0, 1], v=[0, -1], mu=0.2, gradient=True)
    assert tau[0] == 0 and np.isnan(tau[1]) and np.isnan(by["v"]).all()
    with pytest.raises(TypeError, match="neither out nor threads"):
        ct.stop_time(u=1, v=1, mu=0.2, gradient=True, threads=2)


def test_orbit_as_arrays():
    orbit = ct.Flow(mu=0.3).orbit(u=1, v=1)
    states = orbit.at(tau=[[0, 1], [2, orbit.stop_time]])
    assert states.shape == (2, 2) and states.dtype.names == ("tau", "u", "v", "ln_v", "k", "beta")
    assert states[0, 0]["u"] == states[0, 0]["v"] == 1 and states[1, 1]["u"] == 0
    assert orbit.at(tau=1)["u"] == states[0, 1]["u"]
    assert orbit.at(tau_left=orbit.stop_time - 1)["u"] == pytest.approx(states[0, 1]["u"], rel=1e-14)
    assert len(orbit.sample(11)) == 11
    by_beta = orbit.at(beta=states["beta"])
    assert by_beta["tau"] == pytest.approx(states["tau"], rel=1e-9) and (by_beta["beta"] == states["beta"]).all()
    for two in ({"tau_left": 1}, {"beta": 1}):
        with pytest.raises(TypeError, match="one of tau, tau_left and beta"):
            orbit.at(1, **two)


def test_law_of_ones_own():
    c = 3 * math.pi / 16

    def ellipse(sliding, pivoting):
        size = math.hypot(sliding, c * pivoting)
        return sliding / size, c * c * pivoting / size

    assert ct.law(ellipse).name == "ellipse"
    assert ct.law(lambda sliding, pivoting: ellipse(sliding, pivoting)).name == "user's law"
    assert ct.stop_time(u=1, v=1, mu=0.1, law=ellipse) == pytest.approx(33.09573431, abs=1e-8)  # README.md
    rho = np.linspace(0, 1, 2001)
    table = ct.law(rho=rho, pressure=1 - rho**2, name="paraboloid")
    assert table([0.1, 1, 3])[0] == pytest.approx(ct.law("pressure:1")([0.1, 1, 3])[0], rel=1e-12)


def test_an_error_of_ones_own_law_comes_through():
    class Mine(Exception):
        pass

    broken = False

    def law(sliding, pivoting):
        if broken:
            raise Mine("mine", 42)
        return ct.law("exact")._core.force(sliding / pivoting if pivoting else np.inf)[()], 0.5 / (1 + sliding / pivoting) if pivoting else 0

    flow = ct.Flow(mu=0.2, law=law)
    broken = True
    for ask in (lambda: ct.Flow(mu=0.3, law=law), lambda: flow.law(1), lambda: flow.orbit(u=1, v=1).at(1)):
        with pytest.raises(Mine) as raised:
            ask()
        assert raised.value.args == ("mine", 42) and raised.traceback[-1].name == "law"
    for answer in (None, 1, (1, 2, 3), ("a", 2)):
        with pytest.raises(TypeError, match="law f: a pair of numbers"):
            ct.law(lambda sliding, pivoting: answer, name="f")


def test_broadcasting_and_out():
    u, v = np.linspace(-1, 1, 5)[:, None], np.linspace(0, 2, 4)
    flow = ct.Flow(mu=0.3)
    taus = flow.stop_time(u=u, v=v)
    assert taus.shape == (5, 4)
    assert taus[1, 2] == flow.stop_time(u=u[1, 0], v=v[2]) == ct.stop_time(u=u[1, 0], v=v[2], mu=0.3)
    assert isinstance(flow.stop_time(u=1, v=2), float) and isinstance(flow.stop_time(u=np.int64(1), v=2.0), float)
    out = np.empty((5, 4))
    assert flow.stop_time(u=u, v=v, out=out) is out and np.array_equal(out, taus)
    wide = np.zeros((5, 8))
    flow.stop_time(u=u, v=v, out=wide[:, ::2])
    assert np.array_equal(wide[:, ::2], taus) and not wide[:, 1::2].any()
    many = np.linspace(0, 2, 100_000)
    expected = flow.stop_time(u=many, v=many[::-1])
    assert expected[17] == pytest.approx(flow.stop_time(u=many[17], v=many[-18]), rel=1e-15)
    for name, into in (("u", many.copy()), ("shifted", np.append(many, 0)[1:])):
        into[...] = many
        assert np.array_equal(flow.stop_time(u=into, v=many[::-1], out=into), expected), name
    shifted = np.append(many, 0)
    assert np.array_equal(flow.stop_time(u=shifted[:-1], v=many[::-1], out=shifted[1:]), expected)
    assert np.array_equal(flow.stop_time(u=many, v=many[::-1], threads=3), expected)
    assert np.isnan(flow.stop_time(u=[1, np.nan, 1], v=[-1, 1, np.inf])).all()
    assert flow.stop_time(u=np.empty(0), v=np.empty(0)).shape == (0,)
    with pytest.raises(ValueError, match=r"float64 of shape \(5, 4\) is needed, got float32"):
        flow.stop_time(u=u, v=v, out=np.empty((5, 4), np.float32))
    locked = np.empty((5, 4))
    locked.flags.writeable = False
    with pytest.raises(ValueError, match="not writeable|read-only"):
        flow.stop_time(u=u, v=v, out=locked)


def test_a_drive():
    free, driven = ct.Flow(mu=0.3), ct.Flow(mu=0.3, drive=0.2)
    assert (free.drive, driven.drive) == (0, 0.2) and free != driven and free == ct.Flow(0.3, drive=0)
    assert pickle.loads(pickle.dumps(driven)) == driven and "drive=0.2" in repr(driven)
    u, v = np.linspace(-1, 1, 5), np.linspace(0, 2, 4)[:, None]
    taus = driven.stop_time(u=u, v=v)
    assert taus.shape == (4, 5) and (taus >= free.stop_time(u=u, v=v)).all()
    assert taus[2, 1] == driven.stop_time(u=u[1], v=float(v[2, 0])) == ct.stop_time(u=u[1], v=v[2, 0], mu=0.3, drive=0.2)
    (ray,) = driven.terminal().rays
    assert driven.orbit(u=1, v=0).sample(101)["k"][90] == pytest.approx(ray.k, rel=1e-8)
    assert {point.half_line for point in driven.facts()} == {"ray", "u = 0"}
    assert ct.check(u=1, v=1, mu=0.3, drive=0.2).passed
    data = ct.portrait(mu=0.3, drive=0.2, u=1, v=0, orbits=2).data
    assert data["drive"] == 0.2 and data["highlight"]["tau_left"][0] == pytest.approx(driven.orbit(u=1, v=0).stop_time, rel=1e-14)
    for wrong, words in ((1, "never stop"), (-0.1, "against the slip"), (np.nan, "drive")):
        with pytest.raises(ValueError, match=words):
            ct.Flow(mu=0.3, drive=wrong)


def test_mu_may_be_an_array():
    taus = ct.stop_time(u=1, v=[[1], [2]], mu=[0.1, 0.3, 0.1])
    assert taus.shape == (2, 3) and taus[1, 1] == ct.stop_time(u=1, v=2, mu=0.3) and (taus[:, 0] == taus[:, 2]).all()


@pytest.mark.parametrize("drive", [0, 0.1])
def test_many_mus_share_their_flows(drive):
    mus, u, v = np.linspace(0.05, 0.3, 40), np.linspace(-1, 2, 40), np.linspace(0.1, 3, 40)
    tau, by = ct.stop_time(u=u, v=v, mu=mus, law="pade", drive=drive, gradient=True)
    np.testing.assert_array_equal(ct.stop_time(u=u, v=v, mu=mus, law="pade", drive=drive), tau)
    for i in (0, 13, 39):
        wanted, slopes = ct.Flow(mus[i], "pade", drive=drive).stop_time(u=u[i], v=v[i], gradient=True)
        assert tau[i] == pytest.approx(wanted, rel=10 / (1 - drive) * np.finfo(float).eps)
        assert {name: by[name][i] for name in slopes} == pytest.approx(slopes, rel=1e-12)
    unknown = ct.stop_time(u=[1] * 39 + [0], v=[-1] + [1] * 38 + [0], mu=mus, drive=drive, gradient=True)
    assert np.isnan(unknown[0][0]) and unknown[0][39] == 0 and np.isnan(unknown[1]["mu"][[0, 39]]).all()
    with pytest.raises(ValueError, match="mu"):
        ct.stop_time(u=1, v=1, mu=np.append(mus, -1), drive=drive)


def test_other_threads_go_on():
    """A law of Python's and an array, both at once from two threads: neither waits for ever."""
    slow = ct.Flow(mu=0.2, law=lambda sliding, pivoting: ct.law("exact")._core.force(1)[()] and tuple(
        ct.law("exact")(sliding / pivoting if pivoting else np.inf)))
    found = []
    ask = lambda: found.append((slow.orbit(u=1, v=1).at(1)["u"], slow.stop_time(u=np.ones(50_000), v=1.0)[0]))
    threads = [threading.Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive()
    assert found[0] == found[1] == found[2]
    assert found[0][1] == pytest.approx(ct.stop_time(u=1, v=1, mu=0.2), rel=1e-12)


def test_terminal():
    puck = ct.Flow(body="disc").terminal()
    assert puck.k_star == pytest.approx(0.653001789205598, rel=1e-14) and puck.ends[0].limit == "ray"
    assert puck.rays[0].attracts and puck.rays[0].k == puck.k_star
    assert ct.Flow(mu=0.3).terminal().ends == (("zero", 0, 0, math.inf),)
    assert ct.Flow(mu=1, body=(1, 2.5)).terminal().k_star == pytest.approx(0.537779149856729, rel=1e-14)


def test_check():
    checks = ct.check(mu=0.3, u=1, v=1)
    assert {row.law for row in checks} == {"exact", "pade"} and checks.raise_for_failure() is checks and len(checks) > 20
    assert {row.law for row in ct.check(body="disc", u=1, v=1)} == {"uniform"}
    failed = ct.Checks([checks[0]._replace(passed=False), checks[1]])
    with pytest.raises(ArithmeticError, match="FAIL"):
        failed.raise_for_failure()


def test_gradients_of_an_orbit():
    flow = ct.Flow(mu=0.3)
    tau = np.array([[0.5, 2], [5, 20]])
    found = flow.orbit(u=1, v=1).gradient(tau)
    step = 1e-5
    for name, moved in (("u", (step, 0)), ("v", (0, step))):
        more, less = (flow.orbit(u=1 + sign * moved[0], v=1 + sign * moved[1]) for sign in (1, -1))
        for of in ("u", "v"):
            assert found[of][name] == pytest.approx((more.at(tau)[of] - less.at(tau)[of]) / (2 * step), rel=1e-6, abs=1e-9)
        slopes = (more.slip_length(tau) - less.slip_length(tau)) / (2 * step)
        assert found["slip_length"][name] == pytest.approx(slopes, rel=1e-6, abs=1e-9)
    assert (found["slip_length"]["tau"] == found["v"]["value"]).all()
    with pytest.raises(ValueError, match="u not 0 and v > 0 is needed"):
        flow.orbit(u=1, v=0).gradient(1)


@pytest.mark.parametrize("ask, words", [
    (lambda: ct.law("exat"), r"no such law 'exat' \(did you mean 'exact'\?\); laws: exact, pade, .*pressure:P"),
    (lambda: ct.law("pressure:-2"), "-1 < P <= 25 "),
    (lambda: ct.law(lambda s, p: (2 * s, p)), "Phi must be 1 in pure sliding"),
    (lambda: ct.law("exact")(-1), "the ratio k = sliding/pivoting must be >= 0, got -1"),
    (lambda: ct.law(rho=[0, 1], pressure=[0, 0]), "pressure"),
    (lambda: ct.Flow(mu=2), "mu = 2: 0 < mu <= 1 is required"),
    (lambda: ct.Flow(), "mu is missing"),
    (lambda: ct.Flow(mu=1, body="disk"), r"no such body 'disk' \(did you mean 'disc'\?\)"),
    (lambda: ct.Flow(mu=0.3).stop_time(u=1, v=-1), "v must be >= 0|v >= 0"),
    (lambda: ct.Flow(mu=0.3).stop_time(u=[1, 2], v=[1, 2, 3]), "broadcast"),
    (lambda: ct.Flow(mu=0.3).stop_time(u=[1], v=[1], threads=0), "a thread or more"),
    (lambda: ct.Flow(mu=0.3).orbit(u=1, v=1).at(-1), "tau"),
    (lambda: ct.check(mu=0.3, u=0, v=0), "rest"),
])
def test_rejected_in_the_librarys_own_words(ask, words):
    with pytest.raises(ValueError, match=words):
        ask()


def named(sliding, pivoting):
    return sliding / (sliding + 0.4 * pivoting), 0.4 * pivoting / (sliding + 0.4 * pivoting)


@pytest.mark.parametrize("value", [
    ct.law("pressure:2"), ct.law(named), ct.law(rho=[0, 1], pressure=[1, 0.5]), ct.Flow(mu=0.3), ct.Flow(mu=0.2, law=named),
    ct.Flow(mu=0.3).orbit(u=1, v=1), ct.Flow(body="ring").terminal()], ids=lambda value: type(value).__name__)
def test_pickling_and_copying(value):
    for other in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
        assert other == value and hash(other) == hash(value) and repr(other) == repr(value)
