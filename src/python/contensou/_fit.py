"""Friction and patch radius from a film."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, NamedTuple, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._balls import Ball, a_ball
from ._law import Law, LawLike
from ._numbers import flag, needs, numbers, text


class Estimate(NamedTuple):
    """What a film says of one number: in SI units, with its standard error (inf: not determined, and value is any of many;
    0: it was given) and the ends of the interval of 95 % confidence."""

    value: float
    standard_error: float
    low: float
    high: float

    @property
    def determined(self) -> bool:
        return bool(np.isfinite(self.standard_error))


class RollingFrictionSeen(NamedTuple):
    """Rolling friction that was not searched, and by which a film would be explained better by far; what the coefficient of
    sliding friction would be then, and by how much chi^2 less."""

    value: float
    standard_error: float
    friction: float
    chi2_less: float


class Combination(NamedTuple):
    """The one combination of friction and patch_radius that a film determines, in SI units."""

    name: str
    value: float
    standard_error: float
    low: float
    high: float


@dataclass(frozen=True, eq=False)
class Fit:
    """What a film says of a ball; `fit` makes one.

    ball:         with the fitted contact and start, and with the covariance of all that was found in its uncertainty, where
                  the film determines them
    estimates:    of friction, patch_radius, slip, spin, and what places the film: direction, vx, vy, x, y, angle at the start;
                  with rolling friction also rolling_friction, and rolling (m/s, R omega along the slip) for vx and vy
    names, correlation_matrix:  of those that were free
    correlation:  of friction and patch_radius
    noise:        the standard deviation of each observable, given or estimated
    reduced_chi2: nan or inf where there are no more values than numbers to be found
    profiled:     whether the intervals are by profile likelihood
    misfits:      why this is not the motion of the film, in words; empty where it may be
    other_spins:  at the start, which explain the film as well, by other whole turns between two pictures or by another motion
    only:         the one combination of friction and patch_radius that the film determines, where it does no more
    rolling_friction_seen:  where the film shows rolling friction that the ball has not
    aic:          Akaike's criterion, to compare laws on the same film: the smaller the better
    predicted:    what the fitted motion gives, by observable
    t, observed:  the film: times, and what was seen by observable; of a planned one none
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
    misfits: list[str]
    other_spins: list[float]
    only: Optional[Combination]
    rolling_friction_seen: Optional[RollingFrictionSeen]
    predicted: dict[str, NDArray[np.float64]]
    t: NDArray[np.float64]
    observed: dict[str, NDArray[np.float64]]

    def plot(self, axes: Any = None) -> Any:
        """What was seen with the fitted motion, and the residuals below, a column for each observable, by matplotlib into
        axes of shape (2, number of observables), or into a new figure. A marker's angle stands at its turn.
        Gives the axes."""
        if not self.observed:
            raise ValueError("a planned film has nothing to draw")
        units = {"slip": "m/s", "spin": "rad/s", "x": "m", "y": "m", "vx": "m/s", "vy": "m/s", "angle": "rad"}
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
            above.set(ylabel=f"{name}, {units[name]}")
            below.plot(self.t, seen - fitted, ".", color="C7", markersize=3)
            below.axhline(0, color="C3", linewidth=0.8)
            below.set(xlabel="t, s", ylabel="residual")
        axes[0, 0].legend(fontsize="small")
        return axes

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
        """Of a ball that has it, or where it was searched."""
        return self.estimates["rolling_friction"]

    @property
    def slip(self) -> Estimate:
        return self.estimates["slip"]

    @property
    def spin(self) -> Estimate:
        return self.estimates["spin"]


def _same(one: Any, other: Any) -> bool:
    """Equal, NaN with NaN, too."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(_same(each, other[name]) for name, each in one.items())
    return np.array_equal(one, other, equal_nan=True) if isinstance(one, (float, np.ndarray)) else bool(one == other)


def _spreads(given: Any, t: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """The argument sd, a value for each time."""
    if not isinstance(given, dict):
        raise needs("sd", 'a dict by observable, as {"slip": 0.01},', given)
    spreads = {name: numbers(f"sd of {name}", each) for name, each in given.items()}
    for name, each in spreads.items():
        if each.shape not in ((), (1,), t.shape):
            raise ValueError(f"sd of {name}: a number, or one for each time, shape {t.shape}, is needed; got shape {each.shape}")
    return {name: np.broadcast_to(each, t.shape) for name, each in spreads.items()}


def _names(free: Any) -> Optional[list[str]]:
    """The argument free; the name of one parameter is a list of it."""
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
    """Friction and patch radius of a ball, with its slip and spin at t[0], from what a film shows at the times t in s, which
    increase: any of slip (m/s), spin (rad/s about the vertical), place x, y (m) and velocity vx, vy (m/s) of the centre, and
    the angle turned about the vertical (rad, up to whole turns). NaN, and what is masked, was not measured. src/fit/README.md says how to film it.

    ball:    its radius and gravity; the values of what is not free; its law, where none is given
    free:    what is to be found of friction, patch_radius, rolling_friction, slip and spin; all of them if left out, but for
             the patch of a body that rests on its whole face, and rolling friction of a ball that has none
    sd:      standard deviations by observable, numbers or arrays; of others they are estimated, from 10 values or more
    robust:  Huber's loss: values that are far off count for less
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
    """What a film would say of the ball's own motion, before it is made: the standard errors and intervals that it would
    give (Cramer and Rao's bound), as `contensou fit --plan`.

    t:   s, of its pictures, from the start of the motion on
    sd:  standard deviations of what is to be seen of slip, spin, x, y, vx, vy and angle, numbers or arrays
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
    seen_rolling = found.pop("rolling_friction_seen")
    predicted = dict(zip(seen, found.pop("predicted")))
    return Fit(ball=fitted, law=known_law.name, estimates=estimates, predicted=predicted, t=t,
               only=only and Combination(*only),
               rolling_friction_seen=seen_rolling and RollingFrictionSeen(*seen_rolling),
               observed={name: values for name, values in seen.items() if values is not None}, **found)
