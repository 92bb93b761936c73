"""Symmetries of planar systems, and the motions that they solve."""

import copy
import csv
import math
import os
import pickle
import random
import signal
import subprocess

import contensou as ct
import numpy as np
import pytest
from scipy.integrate import solve_ivp

PROGRAM = os.environ.get("CONTENSOU")
SLIDING = "u' = -u/hypot(u, v); v' = -v/hypot(u, v) - a"


def twisting(u, v):
    """A relay: every orbit turns about the origin and is there in finite time."""
    return v, -np.sign(u) - 0.5 * np.sign(v)


def number(text):
    return float(text) if text else None


@pytest.mark.parametrize("row", csv.DictReader(open(os.path.dirname(__file__) + "/../reference/planar_systems.csv")), ids=lambda row: row["system"])
def test_planar_systems_with_known_answers(row):
    u, v, time, t = (number(row[name]) for name in ("u0", "v0", "time", "t"))
    reduction = ct.reduce(row["system"], u=u, v=v)
    assert (reduction.form or "") == row["form"]
    if row["kind"]:
        assert (reduction.kind or "?", len(reduction.rays)) == (row["kind"], int(row["rays"]))
    if not row["form"]:
        return
    orbit = reduction.orbit(u, v)
    assert (orbit.end or "?") == row["end"]
    if time is not None:
        assert orbit.end_time == pytest.approx(math.inf if row["end"] == "periodic" else time, rel=1e-12)
    if t is not None:
        at = orbit.at(t)
        assert math.hypot(at["u"] - float(row["u"]), at["v"] - float(row["v"])) < 1e-11 * math.hypot(at["u"], at["v"])


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
    states = text.orbit(1, 1).at([0.1, 0.5])
    integral = text.first_integral(states["u"], states["v"])
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
    assert (reduction.stop_time(u=u, v=v) == flow.stop_time(u=u, v=v)).all()  # the flow solves it
    assert reduction.stop_time(u=-1, v=-2) == flow.stop_time(u=1, v=2)
    assert (reduction.kind, reduction.form, len(reduction.rays)) == ("stable node", "scaling", 4)
    facts = flow.facts()
    assert len(facts) == 4 and {point.place for point in facts} == {"origin", "infinity"}
    assert {point.kind for point in facts} == {"saddle", "stable node", "unstable node"}


def test_v_is_found_with_the_denominator_cleared():
    quotient = ct.reduce("y' = (y^2-3*x^2*y+x)/(x^3-2*x*y)", u=1.3, v=0.7)
    assert quotient.tried[-1][0] == quotient.form == "constant" and quotient.tried[-1][-1]


def test_a_generator_says_whether_it_holds_everywhere():
    assert [x.everywhere for x in ct.reduce(twisting, u=1, v=1).generators] == [True, False]


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


def test_an_orbit_at_an_array_of_times():
    orbit = ct.reduce(SLIDING, u=1, v=1, a=0.2).orbit(u=3, v=-2)
    times = np.array([[0, 0.5], [1, 2]])
    states = orbit.at(times)
    assert states.dtype.names == ("t", "u", "v", "q", "p") and states.shape == (2, 2)
    np.testing.assert_allclose(np.tan(states["q"]), states["v"] / states["u"], rtol=1e-12)
    # What is left by the quadrature is what was left, less the time.
    left = orbit.reduction.stop_time(u=states["u"], v=states["v"])
    np.testing.assert_allclose(left, orbit.stop_time - times, rtol=1e-11)
    end = orbit.at(orbit.end_time + 1)
    assert orbit.end == "centre" and (end["u"], end["v"], end["p"]) == (0, 0, -math.inf)
    assert orbit.at(0.0)["u"] == pytest.approx(3, rel=1e-15)
    with pytest.raises(ValueError, match="times >= 0"):
        orbit.at([1, -1])
    again = pickle.loads(pickle.dumps(orbit))
    assert repr(again) == repr(orbit) and again.at(1.5) == orbit.at(1.5)


def test_of_zhuravlev_s_system_orbits_are_the_flow_s():
    flow = ct.Flow(mu=0.3)
    states, theirs = flow.reduction().orbit(1, 1).at([1, 5]), flow.orbit(u=1, v=1).at([1, 5])
    np.testing.assert_allclose(states["u"], theirs["u"], rtol=1e-11)
    np.testing.assert_allclose(states["p"], theirs["ln_v"], rtol=1e-9)  # the paper's p
    assert "(2.6), mu = 0.3, law exact" in flow.reduction().portrait(orbits=4).data["system"]


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
@pytest.mark.parametrize("asked, options, looks", [
    ({}, ["--u0", "1", "--v0", "1"], []),
    ({"u": 0.5, "v": 1, "window": (2, 1), "orbits": 6, "isochrones": 3, "field": "motion", "arrows": "one", "axes": False,
      "colour": "none", "style": "screen", "size": (150, 100), "title": "mine"},
     ["--u0", "0.5", "--v0", "1", "--window", "2,1", "--orbits", "6", "--isochrones", "3"],
     ["--field", "motion", "--arrows", "one", "--axes", "off", "--colour", "none", "--style", "screen", "--size", "150x100",
      "--title", "mine"]),
    ({"window": ((-2, 1), (-1, 2)), "through": [(-1, 0.5)], "size": "single"},
     ["--u0", "1", "--v0", "1", "--window=-2:1,-1:2", "--through=-1,0.5"], ["--size", "single"]),
])
def test_a_portrait_is_the_programs(asked, options, looks):
    command = [PROGRAM, "portrait", "--system", SLIDING, "--param", "a=0.2", *options, "-o", "-", "--format"]
    theirs = [subprocess.run([*command, *more], capture_output=True, check=True).stdout for more in (["gp", *looks], ["json"])]
    portrait = ct.reduce(SLIDING, u=asked.get("u", 1), v=1, a=0.2).portrait(**asked)
    assert [portrait.render("gp"), portrait._core.json().encode()] == theirs


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_the_disc_is_the_programs():
    text = "u' = u^2+v^2-1; v' = 5*(u*v-1)"
    command = [PROGRAM, "portrait", "--system", text, "--u0", "1", "--v0", "1", "--view", "disc", "-o", "-", "--format"]
    portrait = ct.reduce(text, u=1, v=1).portrait(view="disc")
    assert [portrait.render("gp"), portrait._core.json().encode()] == [
        subprocess.run([*command, form], capture_output=True, check=True).stdout for form in ("gp", "json")]
    assert portrait.data["degree"] == 2 and len(portrait.data["at_infinity"]) == 6
    with pytest.raises(ValueError, match="the Poincaré disc needs a field whose components are polynomials"):
        ct.reduce("x'' = -sin(x)", u=1, v=0).portrait(view="disc")


def test_a_portrait_of_a_function():
    from matplotlib import pyplot

    reduction = ct.reduce(twisting, u=0.5, v=1)
    portrait = reduction.portrait()
    data = portrait.data
    assert data["system"] == "twisting" and data["window"][0].tolist() == [-1.2, 1.2]
    assert data["highlight"][0]["u"][0] == pytest.approx(0.5)
    assert data["highlight"][0]["tau_left"][0] == pytest.approx(reduction.stop_time(u=0.5, v=1), rel=1e-13)
    for line in data["isochrones"]:
        inside = np.abs(line["u"]) < 1.199  # where no chord is cut at the border
        inside &= np.abs(line["v"]) < 1.199
        times = reduction.stop_time(u=line["u"][inside], v=line["v"][inside])
        np.testing.assert_allclose(times, line["tau_stop"], rtol=1e-9)
    place = portrait.plot()
    pyplot.gcf().canvas.draw()
    assert place.get_xlim() == (-1.2, 1.2) and place.get_legend_handles_labels()[1]
    pyplot.close("all")
    other = pickle.loads(pickle.dumps(portrait))
    assert other.render("gp") == portrait.render("gp") == copy.copy(portrait).render("gp")
    assert ct.reduce(lambda u, v: (-u, -3 * v), u=1, v=1).portrait(orbits=4).data["system"] == "a planar system"


@pytest.mark.parametrize("asked, words", [
    ({"field": "regularised"}, "no such field 'regularised'; fields: none, motion"),
    ({"u": 1}, "a start has both u and v"),
    ({"window": (1, -1)}, "two positive sides"),
    ({"window": (1, 1), "through": [(9, 9)]}, "lies outside the window"),
    ({"orbits": -1}, "must be >= 0"),
])
def test_a_portrait_is_refused_in_the_librarys_words(asked, words):
    with pytest.raises(ValueError, match=words):
        ct.reduce(twisting, u=1, v=1).portrait(**asked)


def test_what_is_not_solved_has_portraits_and_orbits_by_steps_and_ctrl_c_ends_them():
    oscillator = ct.reduce("x'' = (1 - x^2)*x' - x", u=2, v=0)
    assert not oscillator.solved
    motion = oscillator.orbit(2, 0)
    assert motion.end is None and motion.period is None
    times = np.array([0.0, 1.0, 10.0])
    other = solve_ivp(lambda t, x: (x[1], (1 - x[0] ** 2) * x[1] - x[0]), (0, 10), (2, 0), "DOP853", times,
                      rtol=1e-12, atol=1e-13)
    states = motion.at(times)
    assert np.allclose((states["u"], states["v"]), other.y, rtol=0, atol=1e-9)
    portrait = oscillator.portrait(orbits=4, nullclines=True)
    assert portrait.data["variables"] == ["x", "x'"] and len(portrait.data["u_nullclines"]) > 0
    [cycle] = portrait.data["cycles"]
    # The period of van der Pol's oscillator with mu = 1, known to all digits shown (10.1137/0708026).
    assert cycle["stable"] and cycle["period"] == pytest.approx(6.6632868593231, rel=1e-9)
    stopped = False

    def field(u, v):
        if stopped:
            raise KeyboardInterrupt
        return twisting(u, v)

    reduction = ct.reduce(field, u=1, v=1)
    stopped = True
    with pytest.raises(KeyboardInterrupt):
        reduction.portrait(field="motion")


def test_equilibria_and_reversors():
    for system in ("x'' = -sin(x)", lambda u, v: (v, -math.sin(u))):
        reduction = ct.reduce(system, u=1.3, v=0)
        saddle, center, other = reduction.equilibria
        assert (center.kind, saddle.kind, other.kind) == ("center", "saddle", "saddle")
        assert other.u == pytest.approx(math.pi, rel=1e-12)
        assert sorted(value.imag for value in center.eigenvalues) == pytest.approx([-1, 1], rel=1e-10)
        assert reduction.reversors == ("(u, -v)", "(-u, v)")


def test_signals_are_heard_during_a_call():
    """A handler of Python runs several times during one long call. Without looks for signals it would run once, at the end."""
    reduction = ct.reduce("y' = -y*cos(2*x)+sin(x)", u=1, v=1)
    calls = [lambda: reduction.stop_time(u=np.linspace(1, 1.2, 12), v=1.0),
             lambda: ct.stop_time(u=1.0, v=1.0, mu=np.linspace(0.1, 0.9, 2_000_000))]
    for call in calls:
        heard = []
        before = signal.signal(signal.SIGALRM, lambda *_: heard.append(1))
        signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
        try:
            call()
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        assert len(heard) >= 3
