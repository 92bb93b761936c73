"""Fits of films: against SciPy's least_squares on the equations of motion by solve_ivp, and against the program."""

import copy
import json
import os
import subprocess

import contensou as ct
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

PROGRAM = os.environ.get("CONTENSOU")
BALL = ct.Ball.pool(patch_radius=2.8e-3)
T = np.linspace(0, 0.5, 60)
SD = {"slip": 0.01, "spin": 1.0}


def film(seed=1, rolling_friction=0):
    random = np.random.default_rng(seed)
    at = BALL.roll(slip=1, spin=100, rolling_friction=rolling_friction)(T)
    return {"slip": at["slip"] + random.normal(0, SD["slip"], T.size), "spin": at["wz"] + random.normal(0, SD["spin"], T.size)}


def by_scipy(seen, rolling_friction=()):
    """Friction, patch radius, slip, spin and, with a start of it, rolling friction by Newton's equations, with their standard
    errors."""
    law = ct.law("exact")

    def motion(parameters):
        friction, patch, slip, spin, resisting = *parameters[:4], *parameters[4:], *([] if rolling_friction else [0])

        def rate(t, state):
            ln_v, omega = state
            force, moment = law(np.exp(ln_v) / (patch * omega))
            return [-3.5 * (friction * force - resisting) * BALL.gravity / np.exp(ln_v),
                    -2.5 * friction * BALL.gravity * patch * moment / BALL.radius**2]

        run = solve_ivp(rate, (0, T[-1]), [np.log(slip), spin], t_eval=T, method="LSODA", rtol=1e-10, atol=1e-10)
        return np.exp(run.y[0]), run.y[1]

    def residuals(parameters):
        slip, spin = motion(parameters)
        return np.concatenate([(slip - seen["slip"]) / SD["slip"], (spin - seen["spin"]) / SD["spin"]])

    found = least_squares(residuals, [0.3, 2e-3, 0.9, 95, *rolling_friction],
                          x_scale=[0.2, 3e-3, 1, 100, *rolling_friction], jac="3-point", xtol=1e-12, ftol=1e-12)
    return found.x, np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))


def test_estimates_are_those_of_least_squares_on_the_equations_of_motion():
    seen = film()
    values, errors = by_scipy(seen)
    found = ct.fit(T, ball=BALL.but(friction=0.5, patch_radius=1e-3), sd=SD, **seen)
    for name, value, error in zip(("friction", "patch_radius", "slip", "spin"), values, errors):
        estimate = found.estimates[name]
        assert abs(estimate.value - value) < 1e-4 * error
        assert estimate.standard_error == pytest.approx(error, rel=1e-3)


def test_rolling_friction_is_that_of_least_squares_on_the_equations_of_motion():
    seen = film(rolling_friction=0.01)
    values, errors = by_scipy(seen, rolling_friction=[0.02])
    found = ct.fit(T, ball=BALL.but(friction=0.5, patch_radius=1e-3, rolling_friction=0.03), sd=SD, **seen)
    for name, value, error in zip(("friction", "patch_radius", "slip", "spin", "rolling_friction"), values, errors):
        estimate = found.estimates[name]
        assert abs(estimate.value - value) < 1e-3 * error
        assert estimate.standard_error == pytest.approx(error, rel=1e-3)
    assert found.ball.rolling_friction == found.rolling_friction.value and found.rolling_friction_seen is None
    free = ["friction", "patch_radius", "slip", "spin"]
    assert ct.fit(T, ball=BALL.but(rolling_friction=0.01), free=free, sd=SD, **seen).rolling_friction.standard_error == 0
    without = ct.fit(T, ball=BALL, sd=SD, **seen)
    assert without.rolling_friction_seen.value == pytest.approx(found.rolling_friction.value, abs=0.004)
    assert without.rolling_friction_seen.friction > without.friction.value
    assert ct.fit(T, ball=BALL, sd=SD, **film()).rolling_friction_seen is None


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_a_fit_is_the_programs(tmp_path):
    seen = film()
    table = np.column_stack([T, seen["slip"], seen["spin"]])
    np.savetxt(tmp_path / "film.csv", table, delimiter=",", header="t,slip,spin", comments="", fmt="%.17g")
    told = json.loads(subprocess.run([PROGRAM, "fit", tmp_path / "film.csv", "--ball", "pool", "--patch-radius", "2.8e-3",
                                      "--format", "json"], capture_output=True, check=True).stdout)
    found = ct.fit(T, ball=BALL, **seen)
    for name in ("friction", "patch_radius", "slip", "spin"):
        estimate = found.estimates[name]
        assert [*estimate, estimate.determined] == list(told[name].values())
    assert found.correlation == told["correlation"]
    assert found.noise["slip"] == told["noise"]["slip"]["sd"]


def test_the_fitted_ball_moves_as_predicted_and_what_is_wrong_is_said():
    seen = film()
    found = ct.fit(T, ball=BALL, **seen)
    at = found.ball.roll()(T)
    np.testing.assert_allclose(found.predicted["slip"], at["slip"], atol=1e-8)
    np.testing.assert_allclose(found.predicted["spin"], at["wz"], rtol=1e-8)
    assert repr(found).startswith(f"Fit(law='exact', friction={found.friction.value:.6g} +- ") and len(repr(found)) < 250
    assert found.only is None and found.names == ["friction", "patch_radius", "slip", "spin"]
    assert ct.fit(T, ball=BALL, slip=seen["slip"]).only.name == "friction"
    by_spin = ct.fit(T, ball=BALL, spin=seen["spin"])  # any slip may have gone before: not even the product is known
    assert by_spin.only is None and np.isinf(by_spin.friction.high) and np.isinf(by_spin.friction.standard_error)
    for wrong, words in (({"slip": seen["slip"][1:]}, "one value for each time"), ({**seen, "sd": {"x": 1}}, "no values"),
                         ({**seen, "free": ["fricton"]}, "did you mean 'friction'"), ({}, "no value and no stop time")):
        with pytest.raises(ValueError, match=words):
            ct.fit(T, ball=BALL, **wrong)


def test_a_film_of_a_puck_gives_back_the_puck():
    puck = ct.Ball.puck(inertia=0.45)
    t = np.linspace(0, 5, 60)
    at = puck.roll(velocity=(3, -4), angular_velocity=(0, 0, -90))(t)
    found = ct.fit(t, x=at["x"], y=at["y"], spin=at["wz"], ball=puck.but(friction=0.3), sd={"x": 1e-3, "y": 1e-3, "spin": 0.1})
    assert found.friction.value == pytest.approx(0.1, rel=1e-5) and found.slip.value == pytest.approx(5, rel=1e-6)
    assert found.patch_radius.standard_error == 0 and found.estimates["direction"].value == pytest.approx(np.arctan2(-4, 3))
    assert found.ball.roll().stop_time == pytest.approx(puck.roll(slip=5, spin=-90).stop_time, rel=1e-5)
    free = ct.fit(t, slip=at["slip"], spin=at["wz"], ball=puck, sd=SD, free=("friction", "patch_radius", "slip", "spin"))
    assert free.patch_radius.value == pytest.approx(puck.radius, rel=1e-4) and free.patch_radius.standard_error > 0


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_a_plan_is_the_programs():
    times = np.arange(0, 0.5, 1 / 240)
    ours = ct.fit_plan(times, ball=BALL.but(slip=1, spin=100), sd=SD)
    theirs = json.loads(subprocess.run(
        [PROGRAM, "fit", "--plan", "--ball", "pool", "--patch-radius", "0.0028", "--slip", "1", "--spin", "100", "--fps", "240",
         "--until", f"{times[-1]:.17g}", "--noise", "slip=0.01,spin=1", "--format", "json"], capture_output=True, check=True).stdout)
    for name in ("friction", "patch_radius", "slip", "spin"):
        assert getattr(ours, name).standard_error == pytest.approx(theirs[name]["standard_error"], rel=1e-9)
    assert not ours.observed
    with pytest.raises(ValueError, match="nothing to draw"):
        ours.plot()


def test_a_fit_is_drawn_with_the_angle_at_its_turn():
    at = BALL.roll(slip=1, spin=100)
    times = np.linspace(0, 0.3, 50)
    turned = np.array([np.trapezoid(at(line := np.linspace(0, t, 200))["wz"], line) if hasattr(np, "trapezoid")
                       else np.trapz(at(line := np.linspace(0, t, 200))["wz"], line) for t in times])
    fit = ct.fit(times, ball=BALL, slip=at(times)["slip"], angle=np.remainder(turned, 2 * np.pi), sd={"slip": 0.01, "angle": 0.02})
    axes = fit.plot()
    assert axes.shape == (2, 2)
    shown = {each.get_ylabel().split(",")[0]: each for each in axes[0]}
    np.testing.assert_allclose(np.diff(shown["angle"].lines[0].get_ydata()), np.diff(turned), atol=0.1)
    assert abs(axes[1, 1].lines[0].get_ydata()).max() < 0.1


def test_the_fitted_ball_carries_its_covariance(tmp_path):
    ball = ct.Ball.gel()
    t = np.linspace(0, 0.8, 80)
    at = ball.roll(velocity=(0.4, 0.3), angular_velocity=(2, -1, 80))(t)
    sd = {"x": 5e-5, "y": 5e-5, "slip": 0.001, "spin": 0.05}
    found = ct.fit(t, ball=ball, sd=sd, x=at["x"], y=at["y"], slip=at["slip"], spin=at["wz"])
    random = np.random.default_rng(3)
    # The start's velocities from samples of what was found.
    names = ["friction", "patch_radius", "slip", "spin", "direction", "vx", "vy"]
    places = [found.names.index(name) for name in names]
    errors = np.array([found.estimates[name].standard_error for name in names])
    covariance = errors[:, None] * found.correlation_matrix[np.ix_(places, places)] * errors
    drawn = random.multivariate_normal([found.estimates[name].value for name in names], covariance, 200_000, method="eigh").T
    friction, patch, slip, spin, direction, vx, vy = drawn
    wy, wx = (vx - slip * np.cos(direction)) / -ball.radius, (vy - slip * np.sin(direction)) / ball.radius
    by_name = {"friction": friction, "patch_radius": patch, "vx": vx, "vy": vy, "wx": -wx, "wy": -wy, "wz": spin}
    known = dict(found.ball.uncertainty)
    pairs = known.pop("correlation")
    assert list(known) == list(by_name)
    for name, standard in known.items():
        assert standard == pytest.approx(np.std(by_name[name]), rel=0.01)
        for other, correlation in pairs.get(name, {}).items():
            assert correlation == pytest.approx(np.corrcoef(by_name[name], by_name[other])[0, 1], abs=0.01)
    # The file has all of it.
    found.ball.write(tmp_path / "ball.toml")
    again = ct.Ball.read(tmp_path / "ball.toml")
    assert again == found.ball and again.uncertainty == found.ball.uncertainty
    # First order by NumPy: differences, and that covariance.
    values = {"velocity": found.ball.velocity, "angular_velocity": found.ball.angular_velocity,
              "friction": found.ball.friction, "patch_radius": found.ball.patch_radius}

    def length(name, by):
        moved = {key: list(np.atleast_1d(value)) for key, value in values.items()}
        key, place = {"vx": ("velocity", 0), "vy": ("velocity", 1), "wx": ("angular_velocity", 0),
                      "wy": ("angular_velocity", 1), "wz": ("angular_velocity", 2)}.get(name, (name, 0))
        moved[key][place] += by
        roll = found.ball.but(velocity=moved["velocity"], angular_velocity=moved["angular_velocity"],
                              friction=moved["friction"][0], patch_radius=moved["patch_radius"][0]).roll()
        return np.array([roll.slip_length, roll.rolls_after.x, roll.turns])

    slopes = np.array([(length(name, 1e-3 * sd) - length(name, -1e-3 * sd)) / (2e-3 * sd) for name, sd in known.items()])
    spread = np.sqrt(np.diag(slopes.T @ np.cov([by_name[name] for name in known]) @ slopes))
    told = found.ball.roll().uncertainty("fit")
    for event, want in zip((told["slip_length"], told["rolls_after"]["x"], told["turns"]), spread):
        assert event["standard"] == pytest.approx(want, rel=0.01)
        low, high = event["quantiles"][0]["value"], event["quantiles"][-1]["value"]
        assert (high - low) / (2 * 1.96) == pytest.approx(want, rel=0.1)


def test_a_fit_is_equal_to_its_copy():
    seen, free = film(), ("friction", "slip", "spin")
    found = ct.fit(T, **seen, ball=BALL, sd=SD, free=free)
    assert found == found == copy.deepcopy(found) and found in [1, found] and found != 1
    assert found != ct.fit(T, **film(2), ball=BALL, sd=SD, free=free)


def test_no_deviation_where_there_is_no_value():
    seen = film()
    seen["slip"][3] = np.nan
    given, free = np.full(T.size, SD["slip"]), ["friction", "slip", "spin"]
    none = np.where(np.isnan(seen["slip"]), np.nan, given)
    assert ct.fit(T, **seen, ball=BALL, sd={**SD, "slip": none}, free=free) == ct.fit(T, **seen, ball=BALL, sd={**SD, "slip": given}, free=free)
    seen["slip"][4], none[5] = np.nan, np.nan
    with pytest.raises(ValueError, match="^a standard deviation of slip must be finite and > 0; got nan"):
        ct.fit(T, **seen, ball=BALL, sd={**SD, "slip": none}, free=free)


def test_what_an_uncertainty_must_be():
    ball = ct.Ball.pool()
    with pytest.raises(ValueError, match="uncertainty: no such number 'fricton' .did you mean 'friction'"):
        ball.but(uncertainty={"fricton": 0.1})
    with pytest.raises(TypeError, match="uncertainty of slip: a number is needed; got 'x'"):
        ball.but(uncertainty={"slip": "x"})
    with pytest.raises(ValueError, match="no numbers have these correlations"):
        ball.but(uncertainty={"slip": 1, "spin": 1, "friction": 0.1,
                              "correlation": {"slip": {"spin": 0.9, "friction": 0.9}, "spin": {"friction": -0.9}}})
    known = ball.but(uncertainty={"slip": 0.1, "friction": 0.01})
    assert known.but(slip=2).uncertainty == {"friction": 0.01}
    assert known.but(slip=ball.slip).uncertainty == {"slip": 0.1, "friction": 0.01}


def test_errors_that_depend_on_their_neighbours_widen_the_intervals():
    puck, t, random = ct.Ball.puck(), np.linspace(0, 1.5, 200), np.random.default_rng(2)
    at = puck.roll(slip=2, spin=30)(t)
    white = random.normal(0, 1, (2, t.size))
    red = np.zeros_like(white)
    for i in range(1, t.size):
        red[:, i] = 0.6 * red[:, i - 1] + 0.8 * white[:, i]
    plain, real = [ct.fit(t, ball=puck, x=at["x"] + 1e-3 * each[0], spin=at["wz"] + 0.1 * each[1]) for each in (white, red)]
    assert plain.fits and plain.widened is None
    assert real.fits and 1.2 < real.widened.least < real.widened.most and 0 < real.widened.friction_varies < 0.1
    assert real.friction.standard_error > 1.2 * plain.friction.standard_error
