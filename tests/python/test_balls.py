"""Balls in SI: against the program, against the equations of motion by SciPy, and in pooltool's convention."""

import copy
import json
import math
import os
import pickle
import subprocess

import contensou as ct
import numpy as np
import pytest

PROGRAM = os.environ.get("CONTENSOU")


def program(*arguments):
    return json.loads(subprocess.run([PROGRAM, *arguments, "--format", "json"], capture_output=True, check=True).stdout)


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
@pytest.mark.parametrize("given, options", [
    ({"velocity": (1, 0), "angular_velocity": (40, 35, -50)}, ["--velocity", "1,0", "--angular-velocity", "40,35,-50"]),
    ({"slip": 0.5, "spin": 300, "law": "pade", "rolling_below": 1e-2},
     ["--slip", "0.5", "--spin", "300", "--law", "pade", "--rolling-below", "0.01"]),
    ({"strike": 2, "tip": (0.3, -0.2), "elevation": 30, "cue_mass": 0.5, "rolling_friction": 0.01},
     ["--strike", "2", "--tip", "0.3,-0.2", "--elevation", "30", "--cue-mass", "0.5", "--rolling-friction", "0.01"]),
])
def test_a_roll_is_the_programs(given, options):
    theirs = program("roll", "--ball", "gel", *options, "--at", "0,0.1,1,9")
    ours = ct.Ball.gel().roll(**given)
    at = ours([0, 0.1, 1, 9])
    for name in at.dtype.names:
        np.testing.assert_array_equal(at[name], theirs[name], name)
    for roll, told in ((ours, theirs), (ours.uncoupled, theirs["textbook"])):
        assert roll.rolls_after == tuple(told["rolls_after"][each] for each in "txy")
        assert roll.spin_ends == tuple(told["spin_ends"].values())
        assert (roll.rest or ()) == tuple(told.get("rest", {}).values())
        assert [roll.slip_length, roll.turns, roll.path] == [told[each] for each in ("slip_length", "turns", "path")]
    assert ours.stop_time == theirs["t_stop"] and ours.ball.mu(ours.law) == theirs["mu"]
    assert ours.velocity == tuple(theirs["velocity"]) and ours.angular_velocity == tuple(theirs["angular_velocity"])


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_the_balls_are_the_programs(tmp_path):
    names = [ball["name"] for ball in program("balls")["balls"] if hasattr(ct.Ball, ball["name"].replace("-", "_"))]
    assert len(names) >= 7
    for name in names:
        ball = ct.Ball.named(name)
        assert not hasattr(ct.Ball, name) or getattr(ct.Ball, name)() == ball
        subprocess.run([PROGRAM, "balls", name, "-o", str(tmp_path / "mine.toml")], check=True)
        assert ct.Ball.read(tmp_path / "mine.toml") == ball
        assert ball.roll().stop_time == program("stop", "--ball", name)["t_stop"]


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_a_run_files_law_is_that_of_every_answer(tmp_path):
    path = tmp_path / "mine.toml"
    text = subprocess.run([PROGRAM, "balls", "pool"], capture_output=True, check=True, text=True).stdout
    path.write_text(text.replace("[contact]", '[contact]\nlaw = "pade"'))
    ball, pool = ct.Ball.read(path), ct.Ball.pool()
    assert ball == pool.but(law="pade") and ball.law == ct.law("pade")
    assert ball.roll().stop_time == program("stop", "--ball", str(path))["t_stop"] == pool.roll(law="pade").stop_time
    assert ball.roll().stop_time != pool.roll().stop_time == ball.roll(law="exact").stop_time
    assert ball.mu() == pool.mu("pade")
    assert ct.engine("mujoco", ball) == ct.engine("mujoco", pool, law="pade")
    assert ct.portrait(ball=ball, orbits=1).data["law"] == "pade"
    t = np.linspace(0, 1, 50)
    spin = ball.roll(slip=0, spin=50)(t)["wz"]
    found = ct.fit(t, spin=spin, ball=ball, sd={"spin": 1e-3})
    assert found.law == "pade" and found.ball.law == ct.law("pade")


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_a_run_files_law_may_be_formulas(tmp_path):
    path = tmp_path / "mine.toml"
    text = subprocess.run([PROGRAM, "balls", "pool"], capture_output=True, check=True, text=True).stdout
    formulas = "phi = k/hypot(c, k); psi = c^2/hypot(c, k)"
    path.write_text(text.replace("[contact]", f'[contact]\nlaw = "{formulas}"\nparam = {{c = 0.6}}'))
    ball, pool = ct.Ball.read(path), ct.Ball.pool()
    own = ct.law(formulas, c=0.6)
    assert ball.roll().stop_time == program("stop", "--ball", str(path))["t_stop"] == pool.roll(law=own).stop_time
    assert ball.mu() == pool.mu(own) and ball.roll().stop_time != pool.roll().stop_time
    assert ct.engine("mujoco", ball) == ct.engine("mujoco", pool, law=own)
    assert ct.portrait(ball=ball, orbits=1).data["law"] == ball.law.name == formulas + "; c = 0.6"
    assert pickle.loads(pickle.dumps(ball)) == ball == pool.but(law=ball.law.name)
    line = 1 + path.read_text().split("\n").index(f'law = "{formulas}"')
    path.write_text(path.read_text().replace("k/hypot", "k/hypt"))
    with pytest.raises(ValueError, match=rf"mine\.toml:{line}:7: 'hypt' is no .*did you mean 'hypot'\?\).*, at character 9 of"):
        ct.Ball.read(path)


KEYS = {
    "mass": "0.5", "radius": "0.04", "inertia": "0.6", "friction": "0.3", "rolling_friction": "0.01", "patch_radius": "2e-3",
    "spin_deceleration": "7", "youngs_modulus": "[1e9, 2e9]", "poisson_ratio": "[0.3, 0.2]", "counter_radius": "-0.1", "slip": "2", "spin": "-9",
    "velocity": "[1, 2]", "angular_velocity": "[3, 4, 5]", "gravity": "1.6", "load": "3", "slope": "-2"}


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
@pytest.mark.parametrize("key", ct._core.quantities)
def test_every_key_of_a_run_file_is_a_field_of_a_ball(key, tmp_path):
    path, told = tmp_path / "mine.toml", {key: json.loads(KEYS[key])}
    hertz = ("youngs_modulus", "poisson_ratio", "counter_radius")
    if key in hertz:
        told = {each: json.loads(KEYS[each]) for each in hertz[:2] + (key,)}
    ball = ct.Ball.pool(**told)
    options = [word for name, value in told.items()
               for word in ("--" + name.replace("_", "-"), json.dumps(value).strip("[]").replace(" ", ""))]
    theirs = program("roll", "--ball", "pool", *options, "--samples", "3")
    ours = ball.roll()
    assert (ours.stop_time, ours.path, ours.turns) == (theirs["t_stop"], theirs["path"], theirs["turns"])
    assert (ours.rest or ()) == tuple(theirs.get("rest", {}).values())
    assert (ours(ball.roll().stop_time / 2)["energy"] == ct.Ball.pool().roll()(ours.stop_time / 2)["energy"]) is np.False_ \
        or key in ("rolling_friction", "slope")
    for same in (copy.copy(ball), pickle.loads(pickle.dumps(ball)), ct.Ball.pool().but(**told), ball.but()):
        assert same == ball and hash(same) == hash(ball)


def test_a_ball_on_a_slope():
    down, up = ct.Ball.pool(slope=-2, slip=1, spin=100), ct.Ball.pool(slope=2, slip=1, spin=100)
    drive = 2 * np.tan(np.radians(2)) / (7 * down.friction)
    assert ct.portrait(ball=down, orbits=1).data["drive"] == pytest.approx(drive, rel=1e-15)
    assert down.roll().rest is None and up.roll().rest is None
    # Uphill the ball turns round and comes down.
    assert up.roll()(0.1)["vx"] > 0 > up.roll()(20)["vx"]
    held = ct.Ball.pool(slope=0.2, slip=1, spin=100, rolling_friction=0.01)
    assert held.roll().rest.x > 0 and held.but(slope=0) != held


def test_a_load_is_kept(tmp_path):
    pressed = ct.Ball.pool(load=3)
    assert pressed.gravity == 3 / pressed.mass and pressed.but(mass=0.5).gravity == 6
    assert pressed.but(gravity=1.6).load is None
    with pytest.raises(ValueError, match="gravity and load exclude each other"):
        ct.Ball.pool(load=3, gravity=9.8)
    path = tmp_path / "mine.toml"
    path.write_text("""[ball]\nmass = 1\nradius = 0.1\n[contact]\nfriction = 0.2\npatch_radius = 1e-3\n[start]
velocity = [1, 2]\nangular_velocity = [3, 4, 5]\n[environment]\nload = 5\n""")
    ball = ct.Ball.read(path)
    assert (ball.load, ball.gravity, ball.velocity, ball.angular_velocity) == (5, 5, (1, 2), (3, 4, 5))
    assert ball.slip == math.hypot(1 - 0.4, 2 + 0.3) and ball.spin == 5
    assert ball.roll().velocity == (1, 2) and ball.roll(velocity=(0, 1)).angular_velocity == (3, 4, 5)
    assert ball.roll(slip=1, spin=2).angular_velocity == (0, 0, 2)
    # A slip replaces the velocities; the spin that is not given is theirs.
    assert ball.roll(slip=1).angular_velocity == (0, 0, 5)
    with pytest.raises(TypeError, match="a Ball has no mas; it has mass, radius"):
        ball.but(mas=1)
    with pytest.raises(TypeError, match="mass: a number is needed, mass of the ball, in kg; got 'x'"):
        ball.but(mass="x")


def test_a_ball_of_unknown_mass(tmp_path):
    ball = ct.Ball(radius=0.03, friction=0.2, patch_radius=2e-3, slip=1, spin=50)
    assert ball.mass is None
    ball.write(tmp_path / "ball.toml")
    assert "mass" not in (tmp_path / "ball.toml").read_text()
    assert ct.Ball.read(tmp_path / "ball.toml") == ball == pickle.loads(pickle.dumps(ball))
    motion, weighed = ball.roll()(0.1), ball.but(mass=0.2).roll()(0.1)
    assert motion["x"] == weighed["x"] and np.isnan(motion["energy"]) and weighed["energy"] > 0
    for refused in (lambda: ball.but(load=3), lambda: ball.roll(strike=1), lambda: ct.engines(ball)):
        with pytest.raises(ValueError, match="the mass is not known; .* needs it; give mass"):
            refused()


def test_a_puck_lies_flat():
    puck = ct.Ball.puck()
    assert (puck.body, puck.law, puck.patch_radius, puck.mu()) == ("disc", ct.law("uniform"), None, 1)
    roll = puck.roll(slip=5, spin=100)
    assert (round(roll.stop_time, 2), round(roll.path, 2), round(roll.turns, 1)) == (6.27, 14.72, 57.2)
    assert roll.rolls_after.t == roll.stop_time and roll.rolls_after.x == pytest.approx(roll.path) and roll.rest is None
    near = roll(roll.stop_time * (1 - 1e-7))
    assert near["slip"] / (puck.radius * near["wz"]) == pytest.approx(0.653, abs=1e-3)
    assert roll.uncoupled.rolls_after.t == pytest.approx(5 / (0.1 * puck.gravity))
    assert ct.portrait(ball=puck, orbits=1).data["body"] == {"chi": 1, "gamma": 2}
    assert puck.but(body="ring").law == ct.law("ring") and puck.but(inertia=0.4).law == ct.law("uniform")
    assert puck.but(law="exact").but(slip=1).law == ct.law("exact")
    assert ct.Ball(mass=1, radius=0.1, friction=0.1, body="ring").mu() == 1
    for same in (copy.copy(puck), pickle.loads(pickle.dumps(puck)), puck.but(), ct.Ball.named("puck")):
        assert same == puck and hash(same) == hash(puck)


def pooltool_slide(rvw, R, u_s, g, t):
    """What pooltool's slide without spin says: deceleration u_s g against the slip, R w from it by the cross product."""
    r, v, w = rvw
    slip = v + np.cross(w, [0, 0, -R])
    u = slip / np.linalg.norm(slip)
    return np.array([r + v * t - u_s * g * t**2 * u / 2, v - u_s * g * t * u,
                     w - 5 / (2 * R) * u_s * g * t * np.cross(u, [0, 0, 1])])


def test_evolve_has_pooltools_convention():
    ball = ct.Ball.pool()
    rvw = np.array([[0.3, 0.5, ball.radius], [1.0, 0.4, 0], [30.0, -20, 0]])
    before = rvw.copy()
    expected = pooltool_slide(rvw, ball.radius, ball.friction, ball.gravity, 0.05)
    np.testing.assert_allclose(ball.evolve(rvw, 0.05), expected, rtol=1e-12)
    states = ball.evolve(rvw, [[0, 0.05], [1, 2]], rolling_friction=0.01)
    assert states.shape == (2, 2, 3, 3) and np.array_equal(rvw, before)
    np.testing.assert_allclose(states[0, 0], rvw, rtol=1e-15)
    np.testing.assert_allclose(states[0, 1, 1], expected[1], atol=0.02)  # resistance acts while it slides, too
    assert not np.allclose(states[0, 1, 2], expected[2], atol=0.1)
    for r, v, w in states[1]:  # it rolls: w = z x v/R
        np.testing.assert_allclose(w, np.cross([0, 0, 1], v) / ball.radius, atol=1e-10)
    assert np.linalg.norm(states[1, 0, 1] - states[1, 1, 1]) == pytest.approx(0.01 * ball.gravity, rel=1e-9)
    # In two steps or in one.
    rvw[2, 2] = 90
    half = ball.evolve(rvw, 0.1)
    np.testing.assert_allclose(ball.evolve(half, 0.2), ball.evolve(rvw, 0.3), rtol=1e-9)
    for wrong in (rvw[:2], np.diag([1, 1, 1]) * 0 + [[0, 0, 1]]):
        with pytest.raises(ValueError, match="rows r, v, w of a ball on the table|velocity: the ball stays on the plane"):
            ball.evolve(wrong, 0.1)


def test_a_ball_changes():
    pool = ct.Ball.pool(patch_radius=2e-3, spin=50)
    assert pool.spin_deceleration is None and pool.mu() == 2e-3 / pool.radius and pool.roll().angular_velocity[2] == 50
    assert pool.but(spin_deceleration=10, spin=100) == ct.Ball.pool()
    assert ct.Ball(mass=0.17, radius=0.03, friction=0.2, patch_radius=1e-3).roll(slip=1).velocity == (1, 0)
    steel = ct.Ball.steel()
    assert steel == ct.Ball.steel(youngs_modulus=list(steel.youngs_modulus), poisson_ratio=steel.poisson_ratio)


@pytest.mark.parametrize("ask, words", [
    (lambda: ct.Ball(mass=0, radius=1, friction=1, patch_radius=0.1), "mass must be positive|mass"),
    (lambda: ct.Ball(mass=1, radius=1, friction=1), "the patch is missing: give patch_radius, or"),
    (lambda: ct.Ball(mass=1, radius=1, friction=1, patch_radius=0.1, spin_deceleration=1), "exclude each other: give patch_radius, or"),
    (lambda: ct.Ball.named("pol"), r"no such ball 'pol' \(did you mean 'pool'\?\); balls: pool, steel"),
    (lambda: ct.Ball.pool(patch_radius=1), "at most the ball's radius"),
    (lambda: ct.Ball.pool(inertia=0.7), "at most 2/3, as of a hollow-ball"),
    (lambda: ct.Ball.pool(body="bal"), r"no such body 'bal' \(did you mean 'ball'\?\); bodies: ball, hollow-ball, disc, puck, ring"),
    (lambda: ct.Ball.steel(counter_radius=-0.01), "a dish no wider than the ball"),
    (lambda: ct.Ball.pool(counter_radius=1), "spin_deceleration and counter_radius exclude each other"),
    (lambda: ct.Ball.puck().roll(strike=1, tip=(0, 0.2)), "a disc lies flat and turns about the vertical only"),
    (lambda: ct.Ball.puck().roll(rolling_friction=0.01), "it has no rolling friction"),
    (lambda: ct.Ball.pool().roll(strike=1, tip=(0.6, 0)), "the tip slips off the ball"),
    (lambda: ct.Ball.pool().roll(strike=1, spin=0), "strike is a start of its own"),
    (lambda: ct.Ball.pool().roll(velocity=(1, 0), spin=1), "exclude each other"),
    (lambda: ct.Ball.pool().roll(rolling_friction=-1), "rolling_friction must be finite and >= 0"),
    (lambda: ct.Ball.pool(slope=-50).roll(), "never stops sliding"),
    (lambda: ct.Ball.pool(slope=90), "slope must be above -90 and below 90"),
    (lambda: ct.Ball.pool(slope=2, load=3), "a load and a slope exclude each other"),
    (lambda: ct.portrait(ball=ct.Ball.pool(slope=2)), "must slide straight down"),
    (lambda: ct.engine("mujoco", ct.Ball.pool(slope=2)), "takes neither rolling friction nor a slope"),
    (lambda: ct.fit([0, 1], slip=[1, 0.5], ball=ct.Ball.pool(slope=2)), "slope must be 0, got 2 degrees"),
    (lambda: ct.Ball.steel().roll(load=([0, 1], [2, 4])), "grows with a load that changes"),
    (lambda: ct.Ball.puck(slope=-1).roll(load=([0, 1], [2, 4])), "leave out slope|exclude each other"),
    (lambda: ct.Ball.puck().roll(load=([1, 2], [2, 4])), "t must begin with 0"),
    (lambda: ct.Ball.puck().roll(load=([0, 0.1], [2, 0])), "the load ends at 0 before the motion does"),
    (lambda: ct.Ball.pool().roll(rolling_below=-1), "rolling_below: 0 or more is needed"),
    (lambda: ct.Ball.pool().roll(strike=1e300), "exceed the largest double"),
    (lambda: ct.Ball.pool().roll()(-1), "t must be >= 0, in s; got -1"),
])
def test_rejected_in_the_librarys_own_words(ask, words):
    with pytest.raises(ValueError, match=words):
        ask()


def test_a_load_that_changes():
    puck = ct.Ball.puck(slip=1, spin=60)
    doubled = puck.roll(load=([0, 0, 1], [2, 4, 4]))
    assert doubled.stop_time == pytest.approx(puck.but(load=4).roll().stop_time, rel=1e-13)
    assert doubled.uncoupled.stop_time == pytest.approx(puck.but(load=4).roll().uncoupled.stop_time, rel=1e-13)


def test_pickling_and_copying():
    for value in (ct.Ball.puck().roll(load=([0, 1], [2, 4])), ct.Ball.steel(), ct.Ball.gel().roll(strike=1), ct.Ball.gel().roll().uncoupled):
        for other in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
            assert other == value and hash(other) == hash(value) and repr(other) == repr(value)
    assert pickle.loads(pickle.dumps(ct.Ball.pool().roll()))(1) == ct.Ball.pool().roll()(1)


@pytest.mark.parametrize("ball, x", [(ct.Ball.pool(), math.inf), (ct.Ball.pool(rolling_friction=0.01), None), (ct.Ball.puck(), None)])
def test_what_is_for_ever(ball, x):
    roll = ball.roll(slip=1, spin=30)
    last = roll(math.inf)
    assert last["y"] == 0 and last["slip"] == 0 and last["wz"] == 0
    assert last["x"] == (x or roll(1e3)["x"])


def random_starts(count):
    generator = np.random.default_rng(3)
    velocity = generator.uniform(-2, 2, (count, 2))
    return velocity, generator.uniform(-100, 100, (count, 3))


@pytest.mark.parametrize("rolling_friction", [0, 0.01])
def test_many_rolls_are_each_a_roll(rolling_friction):
    velocity, angular_velocity = random_starts(30)
    pool = ct.Ball.pool(rolling_friction=rolling_friction)
    rolls = pool.roll(velocity=velocity, angular_velocity=angular_velocity)
    states = rolls([0, 0.3, 9])
    assert len(rolls) == 30 and states.shape == (30, 3) and rolls(0.3).shape == (30,)
    for i, events in enumerate(rolls.events):
        one = pool.roll(velocity=velocity[i], angular_velocity=angular_velocity[i])
        assert tuple(events["rolls_after"]) == one.rolls_after and tuple(events["spin_ends"]) == one.spin_ends
        assert tuple(events["rest"]) == (one.rest or (math.inf,) * 3)
        assert [events[name] for name in ("slip_length", "turns", "path", "stop_time")] == [one.slip_length, one.turns, one.path, one.stop_time]
        assert rolls[i] == one
        np.testing.assert_array_equal(states[i], one([0, 0.3, 9]))
    np.testing.assert_array_equal(rolls.path, rolls.events["path"])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(rolls)).events, rolls.events)
    assert pickle.loads(pickle.dumps(rolls)) == rolls == copy.copy(rolls) and len({rolls, copy.copy(rolls)}) == 1
    assert rolls[1:3] == pool.roll(velocity=velocity[1:3], angular_velocity=angular_velocity[1:3]) != rolls[2:4] != 3


def test_what_is_not_given_of_many_starts_is_the_balls():
    pool = ct.Ball.pool(slip=1, spin=70)
    np.testing.assert_array_equal(pool.roll(slip=[1, 2]).starts, [[1, 0, 0, 0, 70], [2, 0, 0, 0, 70]])
    np.testing.assert_array_equal(pool.roll(spin=[1, 2]).starts, [[1, 0, 0, 0, 1], [1, 0, 0, 0, 2]])
    np.testing.assert_array_equal(pool.roll(velocity=[[1, 2, 0]], angular_velocity=(1, 2, 3)).starts, [[1, 2, 1, 2, 3]])
    assert pool.roll(velocity=(1, 2, 0)).velocity == (1, 2)
    assert len(pool.roll(slip=[])) == 0 and pool.roll(slip=[]).events.shape == (0,)


def test_many_strokes_threads_and_out():
    pool = ct.Ball.pool()
    strokes = {"strike": [1, 2, 3], "tip": [(0, 0), (0.3, -0.2), (0, 0.4)], "elevation": [0, 30, 5]}
    rolls = pool.roll(**strokes)
    for i in range(3):
        assert rolls[i] == pool.roll(**{name: values[i] for name, values in strokes.items()})
    np.testing.assert_array_equal(pool.roll(strike=2, tip=(0.3, -0.2), elevation=[30, 30]).starts, rolls.starts[[1, 1]])
    velocity, angular_velocity = random_starts(100)
    plain = pool.roll(velocity=velocity, angular_velocity=angular_velocity).events
    out = np.zeros(200, ct.Rolls.dtype)
    by_threads = pool.roll(velocity=velocity, angular_velocity=angular_velocity, threads=3, out=out[::2])
    np.testing.assert_array_equal(out[::2], plain)
    assert not out[1::2]["path"].any() and by_threads.events.base is not None


def test_events_by_flat_names_and_by_events():
    rolls = ct.Ball.pool().roll(slip=[1, 2, 3], spin=50)
    assert rolls.events.dtype.names[:3] == ("rolls_after_t", "rolls_after_x", "rolls_after_y") and len(rolls.events.dtype) == 13
    for name in ("rolls_after", "spin_ends", "rest"):
        for axis in "txy":
            flat = rolls.events[f"{name}_{axis}"]
            assert type(flat) is np.ndarray and flat.dtype == float and rolls.events[1:][f"{name}_{axis}"][0] == flat[1]
            np.testing.assert_array_equal(rolls.events[name][axis], flat)
            assert rolls.events[2][name][axis] == rolls.events[2][f"{name}_{axis}"] == flat[2]
    copied = pickle.loads(pickle.dumps(rolls.events))
    assert copied["rest"].dtype.names == ("t", "x", "y") and copied[0]["path"] == rolls.path[0]
    with pytest.raises(AttributeError, match="^Rolls has no 'rolls_after_t'; it has rolls_after, spin_ends, rest, slip_length"):
        rolls.rolls_after_t


@pytest.mark.parametrize("given, told", [
    ({"velocity": np.ones((10000, 4))}, r"velocity: \(2,\) or \(3,\) is needed, or \(N, 2\) or \(N, 3\) for N starts; got shape \(10000, 4\)"),
    ({"velocity": np.ones((10000, 3))}, "row 0: velocity: the ball stays on the plane, v_z = 0 is needed, got 1.0"),
    ({"velocity": (1, 0, 1)}, "velocity: the ball stays on the plane"),
    ({"velocity": np.ones((5, 2)), "angular_velocity": np.ones((6, 3))}, "as many of each are needed, got 5 of velocity, 6 of angular_velocity"),
    ({"slip": [1, 2, -1, 3]}, "row 2: slip: 0 or more is needed, got -1.0"),
    ({"velocity": [(1, 0), (math.nan, 0)]}, "row 1: "),
    ({"velocity": [(1, 0), (1e300, 0)], "spin": 1}, "slip, spin and velocity, angular_velocity exclude each other"),
    ({"velocity": [(1, 0), (1e300, 0)]}, "row 1: "),
    ({"strike": [1, 2], "tip": [(0, 0), (0, 0.7)]}, "row 1: "),
    ({"strike": [1, 2], "slip": [1, 2]}, "strike is a start of its own: leave out slip"),
    ({"slip": [1, 2], "out": np.zeros(2)}, "out: "),
    ({"slip": 1, "threads": 2}, "threads and out are of an array of starts"),
])
def test_what_is_wrong_with_many_starts_is_told_by_its_row(given, told):
    with pytest.raises(ValueError, match=told) as caught:
        ct.Ball.pool().roll(**given)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize("given", [{"strike": "hard"}, {"slip": "fast"}, {"strike": 1, "tip": "left"}, {"rolling_below": [1, 2]},
                                   {"velocity": ("a", "b")}, {"cue_mass": "heavy", "strike": 1}])
def test_no_words_of_the_binding_reach_the_caller(given):
    with pytest.raises((TypeError, ValueError)) as caught:
        ct.Ball.pool().roll(**given)
    assert not any(word in str(caught.value) for word in ("incompatible", "pybind", "C++", "_core"))
    with pytest.raises(TypeError, match="an array of shape") as caught:
        ct.Ball.pool(velocity=np.ones((10000, 2)))
    assert len(str(caught.value)) < 300


def test_many_balls_evolve():
    velocity, angular_velocity = random_starts(20)
    rvw = np.zeros((20, 3, 3))
    rvw[:, 0], rvw[:, 1, :2], rvw[:, 2] = np.arange(60).reshape(20, 3), velocity, angular_velocity
    pool = ct.Ball.pool()
    later = pool.evolve(rvw, [0.1, 2], rolling_friction=0.01)
    assert later.shape == (20, 2, 3, 3) and pool.evolve(rvw, 0.1).shape == (20, 3, 3)
    for i in range(20):
        np.testing.assert_array_equal(later[i], pool.evolve(rvw[i], [0.1, 2], rolling_friction=0.01))
    with pytest.raises(ValueError, match=r"got shape \(10000, 3\)") as caught:
        pool.evolve(np.zeros((10000, 3)), 1)
    assert len(str(caught.value)) < 200


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_many_rolls_are_the_programs_batch(tmp_path):
    velocity, angular_velocity = random_starts(40)
    starts = np.hstack([velocity, angular_velocity])
    np.savetxt(tmp_path / "shots.csv", starts, delimiter=",", header="vx,vy,wx,wy,wz", comments="", fmt="%.17g")
    run = subprocess.run([PROGRAM, "roll", "--ball", "pool", "--rolling-friction", "0.01", "--batch", str(tmp_path / "shots.csv")],
                         capture_output=True, check=True, text=True)
    theirs = np.genfromtxt(run.stdout.splitlines(), delimiter=",", names=True)
    ours = ct.Ball.pool(rolling_friction=0.01).roll(velocity=velocity, angular_velocity=angular_velocity).events
    for event, name in (("rolls_after", "rolls"), ("spin_ends", "spin_ends"), ("rest", "rest")):
        for axis in "txy":
            np.testing.assert_array_equal(ours[event][axis], theirs[f"{axis}_{name}"])
    for name in ("slip_length", "turns", "path"):
        np.testing.assert_array_equal(ours[name], theirs[name])


def test_a_cloth_of_ones_own_is_kept_whole(tmp_path):
    mine = ct.Ball.pool(name="my cloth", friction=0.16, spin_deceleration=22, rolling_friction=0.008, law="pade", slip=1, spin=3)
    mine.write(tmp_path / "mine.toml")
    assert ct.Ball.read(tmp_path / "mine.toml") == mine
    assert ct.balls()["pool"] == ct.Ball.pool() and set(ct.balls()) > {"gel", "puck", "basketball"}
    typed = mine.but(law=ct.law("phi = k/hypot(c, k); psi = c^2/hypot(c, k)", c=0.5))
    typed.write(tmp_path / "typed.toml")
    read = ct.Ball.read(tmp_path / "typed.toml")
    assert read == typed and read.roll().stop_time == typed.roll().stop_time != mine.roll().stop_time
    with pytest.raises(ValueError, match="a run file has the name of a law"):
        ct.Ball.pool(law=lambda v, w: (v / math.hypot(v, 0.5 * w), 0.25 * w / math.hypot(v, 0.5 * w))).write(tmp_path / "no.toml")


def test_a_roll_is_drawn():
    way, speeds = ct.Ball.pool().roll(velocity=(1, 0), angular_velocity=(40, 35, -50)).plot()
    assert len(way.lines) == 4 and way.get_aspect() == 1 and len(speeds.lines) == 6
    ours, theirs = (line.get_ydata() for line in (speeds.lines[0], speeds.lines[3]))
    assert ours[0] == theirs[0] and ours[-1] < 1e-3


def test_what_events_are_known_to():
    roll = ct.Ball.pool().roll(slip=2, spin=30)
    known = roll.uncertainty(slip="2%", friction=0.01)
    assert known["path"]["standard"] == pytest.approx(np.hypot(*known["path"]["shares"].values()))
    assert [each["probability"] for each in known["t_stop"]["quantiles"]] == [0.025, 0.16, 0.5, 0.84, 0.975]
    with pytest.raises(ValueError, match="no such number 'slp'"):
        roll.uncertainty(slp=0.1)
    assert "rolling_friction" in ct.Ball.pool().roll(slip=2, spin=30, rolling_friction=0.01).gradient()["rest"]["t"]
    gradient = roll.gradient()
    more, less = (ct.Ball.pool().roll(slip=slip, spin=30).rolls_after for slip in (2.0002, 1.9998))
    assert gradient["rolls_after"]["t"]["slip"] == pytest.approx((more.t - less.t) / 4e-4, rel=1e-6)
    assert known["rolls_after"]["t"]["shares"]["slip"] == pytest.approx(0.04 * gradient["rolls_after"]["t"]["slip"], rel=1e-12)
    assert known["path"]["shares"]["friction"] == pytest.approx(0.01 * gradient["path"]["friction"], rel=1e-12)
    with pytest.raises(ValueError, match="gradient needs a constant load and the coupled model"):
        roll.uncoupled.gradient()
    with pytest.raises(ValueError, match="coupled model"):
        roll.uncoupled.uncertainty(slip=0.1)


def test_shots_of_one_ball_share_one_solution():
    from contensou._law import kept_flow

    kept_flow.cache_clear()
    for slip in (0.3, 0.4, 0.5):
        roll = ct.Ball.puck().roll(slip=slip, spin=60)
        assert roll(0.1) == ct.Ball.puck().roll(slip=[slip], spin=60)(0.1)[0]
    assert ct.Ball.puck(friction=0.3).roll(slip=1).stop_time < ct.Ball.puck(friction=0.1).roll(slip=1).stop_time
    assert kept_flow.cache_info().misses == 1
