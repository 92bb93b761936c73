"""Friction and patch radius from a film."""

from __future__ import annotations

from dataclasses import dataclass, fields
from html import escape
from typing import Any, NamedTuple, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._balls import Ball, a_ball
from ._display import picture, table, with_picture
from ._law import Law, LawLike
from ._numbers import flag, needs, numbers, text


class Estimate(NamedTuple):
    """The estimate of one number from a film, in SI units, with its standard error and its interval of 95 % confidence.
    The error is inf for a number that is not determined, and 0 for one that was given."""

    value: float
    standard_error: float
    low: float
    high: float

    @property
    def determined(self) -> bool:
        return bool(np.isfinite(self.standard_error))


class RollingFrictionSeen(NamedTuple):
    """Rolling friction that was not free but would make the fit far better, with the sliding friction that the
    fit then has, and the decrease of chi^2."""

    value: float
    standard_error: float
    friction: float
    chi2_less: float


class Widened(NamedTuple):
    """Neighbouring residuals depend on each other, and errors are widened for this: standard deviation of the friction
    along the path, divided by the friction; smallest and largest factor of an error of friction, patch_radius, slip or
    spin."""

    friction_varies: float
    least: float
    most: float


class Combination(NamedTuple):
    """The only combination of friction and patch_radius that a film determines, in SI units."""

    name: str
    value: float
    standard_error: float
    low: float
    high: float


_units = {"patch_radius": "m", "slip": "m/s", "spin": "rad/s", "direction": "rad", "x": "m", "y": "m", "vx": "m/s", "vy": "m/s",
          "angle": "rad", "rolling": "m/s"}


@dataclass(frozen=True, eq=False)
class Fit:
    """The result of `fit`.

    ball:          the ball with the fitted contact and start; its uncertainty contains the covariance of all free
                   numbers that the film determines
    estimates:     friction, patch_radius, slip, spin, and those that place the film: direction, vx, vy, x, y, angle at
                   the start; with rolling friction also rolling_friction, and rolling (m/s, R omega along the slip)
                   instead of vx and vy
    names, correlation_matrix:  names of the free numbers, and their correlations
    correlation:   correlation of friction and patch_radius
    noise:         standard deviation of each observable, given or estimated
    reduced_chi2:  nan or inf if there are no more values than free numbers
    profiled:      True if the intervals are by profile likelihood
    widened:       None if the motion fits within the noise; else by how much errors are widened
    misfits:       reasons, in words, why the film does not show this motion; empty if it may
    other_spins:   spins at the start that fit the film equally well, by other whole turns between two pictures or by
                   another motion
    only:          the only combination of friction and patch_radius that the film determines, else None
    rolling_friction_seen:  rolling friction that the film shows but the ball does not have, else None
    aic:           Akaike's criterion, to compare laws on the same film; smaller is better
    predicted:     values of the fitted motion, by observable
    t, observed:   times and values of the film, by observable; empty for a planned film
    """

    ball: Ball
    law: str
    estimates: dict[str, Estimate]
    names: list[str]
    correlation_matrix: NDArray[np.float64]
    correlation: float
    noise: dict[str, float]
    reduced_chi2: float
    aic: float
    profiled: bool
    widened: Optional[Widened]
    misfits: list[str]
    other_spins: list[float]
    only: Optional[Combination]
    rolling_friction_seen: Optional[RollingFrictionSeen]
    predicted: dict[str, NDArray[np.float64]]
    t: NDArray[np.float64]
    observed: dict[str, NDArray[np.float64]]

    def plot(self, axes: Any = None) -> Any:
        """Plots the observed values with the fitted motion, and the residuals below, by matplotlib, a column for each
        observable. It draws into axes of shape (2, number of observables), or into a new figure. Angles have the whole
        turns of the fit. Returns the axes."""
        if not self.observed:
            raise ValueError("a planned film has nothing to draw")
        if axes is None:
            from matplotlib import pyplot

            page, axes = pyplot.subplots(2, len(self.observed), figsize=(1.2 + 3.2 * len(self.observed), 4), sharex=True,
                                         squeeze=False, height_ratios=(3, 1), layout="constrained")
            page.suptitle(f"{self.ball.name}, law {self.law}: f = {self.friction.value:.3g}, "
                          f"patch radius {1e3 * self.patch_radius.value:.3g} mm")
        axes = np.asarray(axes).reshape(2, len(self.observed))
        for (name, seen), (above, below) in zip(self.observed.items(), axes.T):
            fitted = self.predicted[name]
            if name == "angle":
                seen = fitted + np.remainder(seen - fitted + np.pi, 2 * np.pi) - np.pi
            above.plot(self.t, seen, ".", color="C7", markersize=3, label="film")
            above.plot(self.t, fitted, "-", color="C3", label="fitted")
            above.set(ylabel=f"{name}, {_units[name]}")
            below.plot(self.t, seen - fitted, ".", color="C7", markersize=3)
            below.axhline(0, color="C3", linewidth=0.8)
            below.set(xlabel="t, s", ylabel="residual")
        axes[0, 0].legend(fontsize="small")
        return axes

    def _repr_svg_(self) -> Optional[str]:
        return picture(self.plot) if self.observed else None

    def _repr_html_(self) -> str:
        rows = [(name, *each, _units.get(name, "")) for name, each in self.estimates.items()]
        caption = f"{self.ball.name}: law {self.law}, reduced chi^2 {self.reduced_chi2:.3g}"
        html = table(caption, ("", "value", "standard error", "95 % from", "to", "unit"), rows)
        for misfit in self.misfits:
            html += f"\n<p>{escape(misfit)}</p>"
        return with_picture(html, self._repr_svg_())

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={each.value:.6g} +- {each.standard_error:.2g}" for name, each in self.estimates.items())
        return f"Fit(law={self.law!r}, {values}, reduced_chi2={self.reduced_chi2:.4g})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Fit) and all(_same(getattr(self, each.name), getattr(other, each.name)) for each in fields(self))

    @property
    def fits(self) -> bool:
        return not self.misfits

    @property
    def friction(self) -> Estimate:
        return self.estimates["friction"]

    @property
    def patch_radius(self) -> Estimate:
        return self.estimates["patch_radius"]

    @property
    def rolling_friction(self) -> Estimate:
        """The estimate of rolling friction. Raises KeyError unless the ball has it or it was free."""
        return self.estimates["rolling_friction"]

    @property
    def slip(self) -> Estimate:
        return self.estimates["slip"]

    @property
    def spin(self) -> Estimate:
        return self.estimates["spin"]


def _same(one: Any, other: Any) -> bool:
    """Returns True if two values are equal; NaN equals NaN."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(_same(each, other[name]) for name, each in one.items())
    return np.array_equal(one, other, equal_nan=True) if isinstance(one, (float, np.ndarray)) else bool(one == other)


def _spreads(given: Any, t: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Returns the argument sd as a value for each time."""
    if not isinstance(given, dict):
        raise needs("sd", 'a dict by observable, as {"slip": 0.01},', given)
    spreads = {name: numbers(f"sd of {name}", each) for name, each in given.items()}
    for name, each in spreads.items():
        if each.shape not in ((), (1,), t.shape):
            raise ValueError(f"sd of {name}: a number, or one for each time, shape {t.shape}, is needed; got shape {each.shape}")
    return {name: np.broadcast_to(each, t.shape) for name, each in spreads.items()}


def _names(free: Any) -> Optional[list[str]]:
    """Returns the argument free as a list; a single name becomes a list."""
    if free is None or isinstance(free, str):
        return None if free is None else [free]
    if not isinstance(free, (list, tuple, set, frozenset)):
        raise needs("free", 'a list of names, as ["friction", "spin"],', free)
    return [text("free", each) for each in free]


def fit(
    t: ArrayLike,
    *,
    ball: Ball,
    slip: Optional[ArrayLike] = None,
    spin: Optional[ArrayLike] = None,
    x: Optional[ArrayLike] = None,
    y: Optional[ArrayLike] = None,
    vx: Optional[ArrayLike] = None,
    vy: Optional[ArrayLike] = None,
    angle: Optional[ArrayLike] = None,
    sd: Optional[dict[str, ArrayLike]] = None,
    law: Optional[LawLike] = None,
    free: Optional[Sequence[str]] = None,
    robust: bool = False,
) -> Fit:
    """Finds friction and patch radius of a ball, with its slip and spin at t[0], from a film with increasing times t in
    s. The film may show any of slip (m/s), spin (rad/s about the vertical), place x, y (m) and velocity vx, vy (m/s) of
    the centre, and the angle turned about the vertical (rad, up to whole turns). NaN and masked entries are not
    measured. src/fit/README.md says how to film.

    ball:    radius, gravity, the values of numbers that are not free, and the default law
    free:    names among friction, patch_radius, rolling_friction, slip and spin; by default all, except
             rolling friction of a ball without it; the patch of a disc or ring only if the film determines a smaller one
    sd:      standard deviations by observable, numbers or arrays; others are estimated, from 10 values or more
    robust:  True for Huber's loss, under which outliers count less
    """
    t = numbers("t", t)
    given = {"slip": slip, "spin": spin, "x": x, "y": y, "vx": vx, "vy": vy, "angle": angle}
    seen = {name: numbers(name, values) for name, values in given.items() if values is not None}
    ball = a_ball(ball)
    for name, values in (("t", t), *seen.items()):
        if values.shape != t.shape or t.ndim != 1:
            raise ValueError(f"{name}: one value for each time is needed, shape {t.shape}; got {values.shape}")
    spreads = {} if sd is None else _spreads(sd, t)
    if not spreads.keys() <= seen.keys():
        raise ValueError(f"sd: of {', '.join(sorted(spreads.keys() - seen.keys()))} there are no values")
    series = [(name, values, spreads.get(name, np.empty(0))) for name, values in seen.items()]
    known_law = ball._law(law)
    found = _core.fit(ball._experiment, known_law._core, t, series, _names(free), flag("robust", robust), False)
    return _report(known_law, found, t, seen)


def fit_plan(
    t: ArrayLike,
    *,
    ball: Ball,
    sd: dict[str, ArrayLike],
    law: Optional[LawLike] = None,
    free: Optional[Sequence[str]] = None,
) -> Fit:
    """Returns the fit that a film of the ball's own motion would give: standard errors and intervals by the bound of
    Cramer and Rao, as `contensou fit --plan`.

    t:   times of its pictures, s, from the start of the motion on
    sd:  standard deviations of slip, spin, x, y, vx, vy or angle, numbers or arrays
    """
    t, ball = numbers("t", t), a_ball(ball)
    spreads = _spreads(sd, t)
    if t.ndim != 1 or not spreads:
        raise ValueError(f"t: times along one axis are needed, and in sd what is to be seen; got shape {t.shape}, {len(spreads)} in sd")
    known_law = ball._law(law)
    series = [(name, np.zeros_like(t), each) for name, each in spreads.items()]
    found = _core.fit(ball._experiment, known_law._core, t, series, _names(free), False, True)
    return _report(known_law, found, t, dict.fromkeys(sd))


def _report(known_law: Law, found: dict[str, Any], t: NDArray[np.float64], seen: dict[str, Any]) -> Fit:
    estimates = {name: Estimate(*each) for name, each in found.pop("estimates").items()}
    fitted = Ball._of(found.pop("ball"), {"law": known_law})
    only = found.pop("only")
    widened = found.pop("widened")
    seen_rolling = found.pop("rolling_friction_seen")
    predicted = dict(zip(seen, found.pop("predicted")))
    return Fit(ball=fitted, law=known_law.name, estimates=estimates, predicted=predicted, t=t,
               only=only and Combination(*only), widened=widened and Widened(*widened),
               rolling_friction_seen=seen_rolling and RollingFrictionSeen(*seen_rolling),
               observed={name: values for name, values in seen.items() if values is not None}, **found)
