"""Balls in SI units."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, fields
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._display import picture, table, with_picture
from ._law import Law, LawLike, body_of, kept, kept_flow, law as law_of
from ._numbers import needs, number, numbers, target, text, thread_count, whole

if TYPE_CHECKING:
    import pandas
    from typing_extensions import Concatenate, ParamSpec

    from ._numbers import Array, Number, NumberOrNone

    Fields = ParamSpec("Fields")
    #: Columns of one start; columns of one start or of many.
    Row = Union[Sequence[float], None]
    Rows = Union[Sequence[float], Sequence[Sequence[float]], None]


def _takes_fields(ball: Callable[[], Callable[Fields, Ball]]) -> Callable[[Callable[..., Ball]], Callable[Concatenate[Any, Fields], Ball]]:
    """Tells type checkers that a method takes the fields of a Ball."""
    return lambda method: method


def _takes_one_and_fields(
        ball: Callable[[], Callable[Fields, Ball]]
) -> Callable[[Callable[..., Ball]], Callable[Concatenate[Any, Union[str, PathLike[str]], Fields], Ball]]:
    """Tells type checkers that a method takes a name or path and the fields of a Ball."""
    return lambda method: method


class Event(NamedTuple):
    """A time of a motion, in s after the start, and the place of the centre at this time, in m from the start."""

    t: float
    x: float
    y: float


@dataclass(frozen=True)
class Ball:
    """A ball on a plane, or a body that lies flat on it, with a typical start. All values are in SI units.

    mass:              kg; None if not known: energies are then nan. A load, moduli, a stroke and engines need it
    patch_radius, spin_deceleration, youngs_modulus, poisson_ratio:  one way to give the contact patch: its radius in m;
                       the rate in rad/s^2 at which a spin without slip falls; or Young's moduli in Pa and Poisson's
                       ratios of ball and plane. counter_radius in m: of another ball (> 0) or a dish (< 0) below, for
                       the patch only
    gravity, load:     m/s^2, 9.80665 by default; or the force in N that presses the ball on the plane
    slip, spin, velocity, angular_velocity:  the start, by default rest: slip in m/s along x and spin in rad/s about the
                       vertical, or velocity (x, y) and angular_velocity (x, y, z up). Velocities also set slip
                       and spin
    rolling_friction:  u_r: a ball that rolls without slip slows down at u_r g
    slope:             angle of the plane in degrees; it rises along x, and falls if negative
    law:               default law of the methods: a name, a Law or a function; by default that of the body
    body:              ball or hollow-ball; disc (puck) or ring lie flat and turn about the vertical only. Their default
                       patch is the whole face, as large as the body
    inertia:           moment of inertia divided by m R^2, instead of that of the named body
    uncertainty:       standard deviations by name as in a run file, such as {"friction": 0.01, "patch_radius": 1e-4};
                       vx, vy, wx, wy, wz for velocities; correlations under "correlation": {"patch_radius":
                       {"friction": -0.7}}. `but` removes the deviations of the numbers that it replaces

    `Ball.pool()` and the like are the balls of `contensou balls`; arguments of the call replace their values.
    """

    mass: Optional[float] = None
    radius: float = None  # type: ignore[assignment]  # never after __init__
    friction: float = None  # type: ignore[assignment]
    patch_radius: Optional[float] = None
    spin_deceleration: Optional[float] = None
    youngs_modulus: Optional[tuple[float, float]] = None
    poisson_ratio: Optional[tuple[float, float]] = None
    gravity: float = None  # type: ignore[assignment]
    slip: float = None  # type: ignore[assignment]
    spin: float = None  # type: ignore[assignment]
    name: str = "ball"
    law: LawLike = None  # type: ignore[assignment]
    rolling_friction: float = 0
    load: Optional[float] = None
    slope: float = 0
    velocity: Optional[tuple[float, float]] = None
    angular_velocity: Optional[tuple[float, float, float]] = None
    body: str = "ball"
    inertia: Optional[float] = None
    counter_radius: Optional[float] = None
    uncertainty: Optional[dict[str, Any]] = field(default=None, hash=False)
    _experiment: _core.Experiment = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        given = {name: getattr(self, name) for name in ("name", "body", "uncertainty", *_core.quantities)}
        known = _core.changed({}, given)
        known["body"] = body_of(known["body"])
        core = _core.Experiment(known)
        if self.velocity is not None or self.angular_velocity is not None:
            known["velocity"], known["angular_velocity"] = core.start
        derived = {"gravity": core.gravity, "slip": core.slip, "spin": core.spin}
        law = law_of(core.law if self.law is None else self.law)
        vars(self).update({**derived, **known, "law": law, "_experiment": core})

    def _given(self) -> dict[str, Any]:
        """Returns the fields that determine the ball, without those that follow from them."""
        derived = {"gravity"} if self.load is not None else set()
        if self.velocity is not None:
            derived |= {"slip", "spin"}
        if self.law == law_of(self._experiment.law):
            derived |= {"law"}
        return {name: vars(self)[name] for name in _fields if name not in derived and vars(self)[name] is not None}

    def __reduce__(self) -> tuple[Any, ...]:
        return Ball._of, (self._given(), {})

    @classmethod
    def _of(cls, known: dict[str, Any], changes: dict[str, Any]) -> Ball:
        law = {"law": changes.get("law", known.get("law"))}
        for key in changes.keys() - _fields:
            raise TypeError(f"a Ball has no {key}; it has {', '.join(_fields)}")
        return cls(**_core.changed(known, changes), **law)

    @_takes_fields(lambda: Ball)
    def but(self, **changes: Any) -> Ball:
        """Returns the ball with other fields. A field replaces fields that determine the same value in
        another way: patch_radius replaces moduli, a load gravity, slip with spin the velocities."""
        return self._of(self._given(), changes)

    @classmethod
    @_takes_one_and_fields(lambda: Ball)
    def read(cls, path: Union[str, PathLike[str]], **changes: Any) -> Ball:
        """Returns the ball of a run file (TOML), such as `contensou balls pool -o mine.toml` writes."""
        return cls._of(_core.parse_run_file(Path(path).read_text(encoding="utf-8"), str(path)), changes)

    def write(self, path: Union[str, PathLike[str]]) -> None:
        """Writes the ball as a run file (TOML) for `read` and `contensou --ball`: name, contact, start and law.
        Raises ValueError for a law that is a function or a table, because a file cannot name it."""
        name = law_of(self.law).name
        try:
            known = law_of(name)
        except ValueError:
            known = None
        if known != self.law:
            raise ValueError(f"law {name!r}: a run file has the name of a law, or its formulas")
        Path(path).write_text(_core.run_file(self._experiment, name), encoding="utf-8")

    @classmethod
    @_takes_one_and_fields(lambda: Ball)
    def named(cls, name: str, /, **changes: Any) -> Ball:
        """Returns the ball with a name of `contensou balls`."""
        return cls._of(_core.ball(text("name", name)), changes)

    @classmethod
    @_takes_fields(lambda: Ball)
    def pool(cls, **changes: Any) -> Ball:
        """A pool ball on cloth."""
        return cls.named("pool", **changes)

    @classmethod
    @_takes_fields(lambda: Ball)
    def steel(cls, **changes: Any) -> Ball:
        """A steel ball of 20 mm on glass."""
        return cls.named("steel", **changes)

    @classmethod
    @_takes_fields(lambda: Ball)
    def bowling(cls, **changes: Any) -> Ball:
        """A bowling ball on a dry lane."""
        return cls.named("bowling", **changes)

    @classmethod
    @_takes_fields(lambda: Ball)
    def rubber(cls, **changes: Any) -> Ball:
        """A rubber ball on steel."""
        return cls.named("rubber", **changes)

    @classmethod
    @_takes_fields(lambda: Ball)
    def gel(cls, **changes: Any) -> Ball:
        """A gel ball on a rigid plane, whose sliding and spinning are visibly coupled."""
        return cls.named("gel", **changes)

    @classmethod
    @_takes_fields(lambda: Ball)
    def basketball(cls, **changes: Any) -> Ball:
        """A basketball on a wooden floor, a hollow ball."""
        return cls.named("basketball", **changes)

    @classmethod
    @_takes_fields(lambda: Ball)
    def puck(cls, **changes: Any) -> Ball:
        """An ice hockey puck, a disc that lies flat."""
        return cls.named("puck", **changes)

    def mu(self, law: Optional[LawLike] = None) -> float:
        """Returns mu, the patch radius divided by the radius of the ball."""
        return self._experiment.patch_and_body(self._law(law)._core)[0]

    def _law(self, asked: Optional[LawLike]) -> Law:
        """Returns the given law, or by default the law of the ball."""
        return law_of(self.law if asked is None else asked)

    @overload
    def roll(  # type: ignore[misc]
        self, *, velocity: Row = None, angular_velocity: Row = None, slip: NumberOrNone = None, spin: NumberOrNone = None,
        strike: NumberOrNone = None, tip: Row = None, elevation: NumberOrNone = None, cue_mass: NumberOrNone = None,
        law: Optional[LawLike] = None, rolling_below: Optional[float] = None, rolling_friction: Optional[float] = None,
        load: Optional[tuple[ArrayLike, ArrayLike]] = None, threads: int = 1, out: None = None) -> Roll: ...
    @overload
    def roll(
        self, *, velocity: Rows = None, angular_velocity: Rows = None, slip: Optional[ArrayLike] = None, spin: Optional[ArrayLike] = None,
        strike: Optional[ArrayLike] = None, tip: Rows = None, elevation: Optional[ArrayLike] = None, cue_mass: Optional[ArrayLike] = None,
        law: Optional[LawLike] = None, rolling_below: Optional[float] = None, rolling_friction: Optional[float] = None,
        load: Optional[tuple[ArrayLike, ArrayLike]] = None, threads: int = 1, out: Optional[NDArray[Any]] = None) -> Rolls: ...
    @overload
    def roll(
        self, *, velocity: Union[Rows, Array] = None, angular_velocity: Union[Rows, Array] = None, slip: Optional[ArrayLike] = None,
        spin: Optional[ArrayLike] = None, strike: Optional[ArrayLike] = None, tip: Union[Rows, Array] = None,
        elevation: Optional[ArrayLike] = None, cue_mass: Optional[ArrayLike] = None, law: Optional[LawLike] = None,
        rolling_below: Optional[float] = None, rolling_friction: Optional[float] = None,
        load: Optional[tuple[ArrayLike, ArrayLike]] = None, threads: int = 1, out: Optional[NDArray[Any]] = None) -> Any: ...
    def roll(
        self, *, velocity: Any = None, angular_velocity: Any = None, slip: Any = None, spin: Any = None,
        strike: Any = None, tip: Any = None, elevation: Any = None, cue_mass: Any = None, law: Optional[LawLike] = None,
        rolling_below: Optional[float] = None, rolling_friction: Optional[float] = None,
        load: Optional[tuple[ArrayLike, ArrayLike]] = None, threads: int = 1, out: Optional[NDArray[Any]] = None) -> Any:
        """Returns the motion of the ball, or of the body that lies flat, as a Roll. By default it has the ball's own
        start. If one of the following arguments has one more axis, of length N, there are N starts, and the result is
        Rolls.

        velocity, angular_velocity:  (x, y) or (x, y, 0) of the centre, m/s; (x, y, z) of the ball, rad/s, z up
        slip, spin:  slip along x, m/s; spin about the vertical, rad/s
        strike, tip, elevation, cue_mass:  a cue strikes the ball at rest along x: its speed, m/s; the place of its tip
                     to the right of and above the centre in radii, default (0, 0); elevation of its butt in degrees,
                     default 0; its mass, default 0.54 kg

        law:               by default that of the ball
        rolling_below:     slip below which the ball rolls, default 0.001 m/s; not for a body that lies flat
        rolling_friction:  u_r: a ball that rolls without slip slows down at u_r g; by default that of the ball
        load:              a changing load: times in s from 0 on, and newtons at each, linear between them and constant
                           after the last. The patch is constant; only friction may act
        threads, out:      for N starts: number of threads; array for their events, shape (N,), dtype Rolls.dtype

        Raises ValueError for values that no ball can have, with the row in the message.
        """
        given = {"velocity": velocity, "angular_velocity": angular_velocity, "slip": slip, "spin": spin,
                 "strike": strike, "tip": tip, "elevation": elevation, "cue_mass": cue_mass}
        start = {name: _rows(name, value, *_widths[name]) for name, value in given.items() if value is not None}
        own, of_stroke = (", ".join(name for name in start if (name in _stroke) is so) for so in (False, True))
        if strike is not None and own:
            raise ValueError(f"strike is a start of its own: leave out {own}")
        if strike is None and of_stroke:
            raise ValueError(f"{of_stroke} of a stroke, which there is none: give strike, the speed of the cue in m/s")
        if strike is not None:
            start = {name: start.get(name, usual) for name, usual in _stroke.items()}
        if rolling_below is not None and self.body in _flat:
            raise ValueError(f"rolling_below: a {self.body} lies flat and never rolls: leave it out")
        below = _core.rolling_slip if rolling_below is None else number("rolling_below", rolling_below)
        if not below >= 0:
            raise ValueError(f"rolling_below: 0 or more is needed, in m/s; got {below}")
        rolling = self if rolling_friction is None else self.but(rolling_friction=number("rolling_friction", rolling_friction))
        count = _count(start)
        if count is None:
            if threads != 1 or out is not None:
                raise ValueError("threads and out are of an array of starts; this is one")
            ball = rolling if strike is not None else rolling.but(**{name: value.tolist() for name, value in start.items()})
            history = None
            if load is not None:
                history, ball = ball._under(load)
            core = ball._experiment
            if strike is not None:
                core = core.struck(*(value.tolist() for value in start.values()))
                ball = ball.but(velocity=core.start[0], angular_velocity=core.start[1])
            return Roll(ball, *core.start, ball._law(law), below, load=history)
        if load is not None:
            raise ValueError("load: a load that changes needs one start, and these are several")
        if strike is not None:
            columns = [np.broadcast_to(value, (count, *_widths[name][0])) for name, value in start.items()]
            starts = _core.struck_starts(self._experiment, np.column_stack(columns))
        else:
            starts = self._starts(start, count)
        return Rolls(rolling, starts, self._law(law), below, thread_count(threads), out)

    def _starts(self, given: dict[str, NDArray[np.float64]], count: int) -> NDArray[np.float64]:
        """Returns rows vx, vy, wx, wy, wz. Values that are not given are the ball's own, as in `but`."""
        if {"slip", "spin"} & given.keys() and {"velocity", "angular_velocity"} & given.keys():
            raise ValueError("slip, spin and velocity, angular_velocity exclude each other: keep one kind of start")
        if count == 0:
            return np.empty((0, 5))
        if "slip" in given:
            bad = np.flatnonzero(~(given["slip"] >= 0))
            if bad.size:
                raise ValueError(f"row {bad[0]}: slip: 0 or more is needed, got {given['slip'].flat[bad[0]]}")
        rest = {"velocity": (0, 0), "angular_velocity": (0, 0, 0), "slip": 0, "spin": 0}
        at_rest: dict[str, Any] = {name: rest[name] for name in given}
        own = self.but(**at_rest)
        starts = np.empty((count, 5))
        velocity, angular_velocity = own._experiment.start
        starts[:, :2], starts[:, 2:] = velocity, angular_velocity
        for name, columns in (("velocity", slice(0, 2)), ("angular_velocity", slice(2, 5)), ("slip", 0), ("spin", 4)):
            if name in given:
                starts[:, columns] = given[name]
        return starts

    def _under(self, load: tuple[ArrayLike, ArrayLike]) -> tuple[Any, Ball]:
        """Returns a changing load as two tuples, and this ball under its nominal load."""
        if not isinstance(load, (tuple, list, np.ndarray)) or len(load) != 2:
            raise needs("load", "(instants in s, newtons at each)", load)
        t, newtons = (tuple(np.atleast_1d(numbers("load", each)).tolist()) for each in load)
        ball = self.but(load=_core.LoadHistory(list(t), list(newtons)).nominal)
        if ball.youngs_modulus is not None:
            raise ValueError("load: the patch of Young's moduli grows with a load that changes, and the motion is then "
                             "no other one's copy: give patch_radius")
        if ball.slope or ball.rolling_friction:
            raise ValueError("load: a load that changes allows friction alone: leave out slope and rolling_friction")
        return (t, newtons), ball

    def evolve(
        self,
        rvw: ArrayLike,
        t: ArrayLike,
        *,
        law: Optional[LawLike] = None,
        rolling_below: Optional[float] = None,
        rolling_friction: Optional[float] = None,
    ) -> NDArray[np.float64]:
        """Returns the state of a ball t seconds later, in the convention of pooltool: rows r, v and w are the place of
        the centre in m, its velocity in m/s and the angular velocity in rad/s, z up. t >= 0 has any shape S. The
        result is a new array of shape (*S, 3, 3). For N balls, with rvw of shape (N, 3, 3), it is (N, *S, 3, 3)."""
        rvw = numbers("rvw", rvw)
        if rvw.ndim not in (2, 3) or rvw.shape[-2:] != (3, 3):
            raise ValueError(f"rvw: rows r, v, w of a ball on the table, shape (3, 3) or (N, 3, 3); got shape {rvw.shape}")
        roll = self.roll(velocity=rvw[..., 1, :], angular_velocity=rvw[..., 2, :], law=law,
                         rolling_below=rolling_below, rolling_friction=rolling_friction)
        at = np.asarray(roll(t))
        result = np.zeros((*at.shape, 3, 3))
        for row, column, name in ((0, 0, "x"), (0, 1, "y"), (1, 0, "vx"), (1, 1, "vy"), (2, 0, "wx"), (2, 1, "wy"), (2, 2, "wz")):
            result[..., row, column] = at[name]
        result[..., 0, :] += rvw[..., 0, :].reshape(*rvw.shape[:-2], *[1] * (at.ndim - rvw.ndim + 2), 3)
        return result


_fields = {each.name: None for each in fields(Ball) if each.init}  # in their order


def a_ball(given: Any) -> Ball:
    if not isinstance(given, Ball):
        raise TypeError(f"ball: a Ball is needed, as Ball.pool(); got {given!r:.60}")
    return given


def balls() -> dict[str, Ball]:
    """Returns the built-in balls by their names, in the order of `contensou balls`."""
    return {name: Ball.named(name) for name in _core.balls}


_flat = ("disc", "ring")

#: Arguments that give a start, each with its shape for one start and its allowed numbers of columns.
_widths: dict[str, tuple[tuple[int, ...], tuple[int, ...]]] = {
    "velocity": ((2,), (2, 3)), "angular_velocity": ((3,), (3,)), "slip": ((), ()), "spin": ((), ()),
    "strike": ((), ()), "tip": ((2,), (2,)), "elevation": ((), ()), "cue_mass": ((), ()),
}

#: Default values of a stroke in the order of _core; strike is always given.
_stroke = {"strike": np.array(np.nan), "tip": np.zeros(2), "elevation": np.array(0.0), "cue_mass": np.array(_core.standard_cue_mass)}


def _rows(name: str, given: ArrayLike, one: tuple[int, ...], widths: tuple[int, ...]) -> NDArray[np.float64]:
    """Returns an argument of one start or of N.
    Raises ValueError for another shape, and for a velocity that leaves the plane."""
    array = numbers(name, given)
    if array.ndim not in (len(one), len(one) + 1) or (one and array.shape[-1] not in widths):
        few = " or ".join(f"({width},)" for width in widths) if one else "one number"
        many = " or ".join(f"(N, {width})" for width in widths) if one else "(N,)"
        raise ValueError(f"{name}: {few} is needed, or {many} for N starts; got shape {array.shape}")
    if name == "velocity" and array.shape[-1] == 3:
        up = np.flatnonzero(array[..., 2] != 0)
        if up.size:
            row = f"row {up[0]}: " if array.ndim == 2 else ""
            raise ValueError(f"{row}velocity: the ball stays on the plane, v_z = 0 is needed, got {array[..., 2].flat[up[0]]}")
        array = array[..., :2]
    return array


def _count(start: dict[str, NDArray[np.float64]]) -> Optional[int]:
    """Returns the number of starts; None if no argument has an axis of starts."""
    counts = {name: value.shape[0] for name, value in start.items() if value.ndim > len(_widths[name][0])}
    if len(set(counts.values())) > 1:
        raise ValueError(f"as many of each are needed, got {', '.join(f'{count} of {name}' for name, count in counts.items())}")
    return next(iter(counts.values()), None)


_Undisturbed = tuple[_core.Experiment, _core.Law, float]  # not a member, because _core is a field of the classes below


@dataclass(frozen=True)
class Roll:
    """The motion of a ball from one start; `Ball.roll` makes it. Called with times t >= 0 in s of any shape, it returns
    a structured array of that shape with fields t, x, y, vx, vy, wx, wy, wz, slip, energy (s, m, m/s, rad/s, J). The
    centre starts at (0, 0)."""

    ball: Ball
    velocity: tuple[float, float]
    angular_velocity: tuple[float, float, float]
    law: Law
    rolling_below: float
    textbook: bool = False
    load: Optional[tuple[tuple[float, ...], tuple[float, ...]]] = None
    _core: _core.Motion = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        experiment = self.ball._experiment
        if experiment.start != (self.velocity, self.angular_velocity):
            experiment = self.ball.but(velocity=self.velocity, angular_velocity=self.angular_velocity)._experiment
        load = None if self.load is None else _core.LoadHistory(list(self.load[0]), list(self.load[1]))
        if self.textbook:
            core = _core.Motion.uncoupled(experiment, self.law._core, load, self.rolling_below)
        else:
            mu, body = experiment.patch_and_body(self.law._core)
            core = _core.Motion.reduced(experiment, kept(kept_flow, mu, self.law, body, 0), load)
        object.__setattr__(self, "_core", core)

    def __reduce__(self) -> tuple[Any, ...]:
        return Roll, tuple(getattr(self, each.name) for each in fields(self) if each.init)

    @overload
    def __call__(self, t: Number) -> np.void: ...  # type: ignore[misc]
    @overload
    def __call__(self, t: ArrayLike) -> NDArray[np.void]: ...
    def __call__(self, t: ArrayLike) -> Any:
        return self._core.at(numbers("t", t))[()]

    def plot(self, axes: Any = None, until: Optional[float] = None) -> Any:
        """Plots the path on the table, to scale, and the speeds against time by matplotlib, with the uncoupled model
        dashed. It draws into two axes, or a new figure, up to `until` in s, by default a little after the ball rolls.
        Returns the axes."""
        if axes is None:
            from matplotlib import pyplot

            page, axes = pyplot.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
            page.suptitle(f"{self.ball.name}: law {self.law.name}")
        way, speeds = axes
        rolls = self.rolls_after.t, self.uncoupled.rolls_after.t
        end = number("until", until) if until is not None else 1.6 * max(rolls) or self.stop_time or 1
        times = np.linspace(0, end, 400)
        for roll, style, words in ((self, "-", "this motion"), (self.uncoupled, "--", "textbook")):
            at = roll(times)
            way.plot(at["x"], at["y"], style, color="C0" if style == "-" else "C7", label=words)
            event = roll.rolls_after
            if event.t <= end:
                way.plot(event.x, event.y, "o", color="C0" if style == "-" else "C7", markerfacecolor="white",
                         label="rests" if self.ball.body in _flat else "rolls")
            note = "" if style == "-" else ", textbook"
            speeds.plot(times, at["slip"], style, color="C3", label="slip" + note)
            speeds.plot(times, self.ball.radius * abs(at["wz"]), style, color="C2", label="$R|\\omega_z|$" + note)
            speeds.plot(times, np.hypot(at["vx"], at["vy"]), style, color="C0", label="speed of the centre" + note)
        way.set(xlabel="x, m", ylabel="y, m", aspect="equal", adjustable="datalim")
        speeds.set(xlabel="t, s", ylabel="m/s", xlim=(0, end))
        speeds.set_ylim(bottom=0)
        way.legend(fontsize="small", loc="upper left", bbox_to_anchor=(0, -0.2), ncols=2, frameon=False)
        speeds.legend(fontsize="small", loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
        return axes

    def _repr_svg_(self) -> Optional[str]:
        return picture(self.plot)

    def _repr_html_(self) -> str:
        motions = [self] if self.textbook else [self, self.uncoupled]
        ends = "rests" if self.ball.body in _flat else "rolls"
        asked: dict[str, Callable[[Roll], Any]] = {
            f"{ends} after, s": lambda roll: roll.rolls_after.t, f"{ends} at x, m": lambda roll: roll.rolls_after.x,
            f"{ends} at y, m": lambda roll: roll.rolls_after.y, "path until then, m": lambda roll: roll.path,
            "length of slip, m": lambda roll: roll.slip_length, "spin ends after, s": lambda roll: roll.spin_ends.t,
            "turns": lambda roll: roll.turns}
        if self.rest is not None:
            asked["centre rests after, s"] = lambda roll: roll.rest.t if roll.rest is not None else "never"
        head = ["", "textbook" if self.textbook else "this motion", "textbook"][:len(motions) + 1]
        rows = [[name, *(find(roll) for roll in motions)] for name, find in asked.items()]
        return with_picture(table(f"{self.ball.name}: law {self.law.name}", head, rows), self._repr_svg_())

    @property
    def rolling_friction(self) -> float:
        """The rolling friction u_r of the ball."""
        return self.ball.rolling_friction

    @property
    def uncoupled(self) -> Roll:
        """The motion under the uncoupled model, in which sliding and spinning are independent, from the same start."""
        return Roll(self.ball, self.velocity, self.angular_velocity, self.law, self.rolling_below, True, self.load)

    @cached_property
    def _events(self) -> np.void:
        row: np.void = self._core.events(self.rolling_below).view(Rolls.dtype)[0]
        return row

    @property
    def rolls_after(self) -> Event:
        """The time at which the slip has fallen to rolling_below, or a body that lies flat rests, and the place."""
        return Event(*self._events["rolls_after"].item())

    @property
    def spin_ends(self) -> Event:
        """The time at which the spin ends, and the place; the start for a ball without spin."""
        return Event(*self._events["spin_ends"].item())

    @property
    def rest(self) -> Optional[Event]:
        """The time at which the centre comes to rest, with rolling friction or on a slope, and the place; None if it
        rolls for ever, and for a body that lies flat on a level plane, which rests at rolls_after."""
        rest = Event(*self._events["rest"].item())
        return rest if np.isfinite(rest.t) else None

    @property
    def stop_time(self) -> float:
        """The time until slip and spin end, s."""
        return self._core.stop_time

    @property
    def slip_length(self) -> float:
        """The length that the contact point slides, m."""
        return float(self._events["slip_length"])

    @property
    def turns(self) -> float:
        """The number of turns about the vertical until the spin ends."""
        return float(self._events["turns"])

    @property
    def path(self) -> float:
        """The length of the centre's path until the ball rolls, m."""
        return float(self._events["path"])

    def uncertainty(self, *own: str, **spreads: Union[str, float]) -> dict[str, Any]:
        """Returns the uncertainty of the events from standard deviations of numbers of the ball or of its start:
        `roll.uncertainty(slip="1%", spin="2 rad/s", friction=0.01)`; vx, vy, wx, wy, wz for a start by velocities.
        `roll.uncertainty("fit")` uses the deviations of the ball (Ball.uncertainty); arguments replace them.

        The result is the member uncertainty of `contensou roll --uncertainty --format json`. For each number of an
        event it contains the standard deviation to first order, the shares in it by name, quantiles of 10 000 samples
        (1 000 with rolling friction, on a slope, or if the patch radius divided by the ball radius varies), and
        first_order_holds, True if standard deviation and quantiles agree.
        Raises ValueError for a number without a value, an invalid deviation, a changing load, and the uncoupled model.
        """
        typed = ",".join([*(text("uncertainty", each) for each in own),
                          *(f"{name}={spread if isinstance(spread, str) else repr(number(name, spread))}" for name, spread in spreads.items())])
        found: dict[str, Any] = json.loads(_core.roll_uncertainty(*self._undisturbed("uncertainty"), typed))
        return found

    def gradient(self) -> dict[str, Any]:
        """Returns the derivative of each number of an event by each number of the ball and of its start, in SI units:
        `roll.gradient()["rolls_after"]["t"]["friction"]`. It is the member gradient of `contensou roll --gradient
        --format json`. A number at which the events have no derivative, such as a spin of 0, is left out. The error is
        1e-8, and larger for a motion that is integrated in steps.
        """
        found: dict[str, Any] = json.loads(_core.roll_gradient(*self._undisturbed("gradient")))
        return found

    def _undisturbed(self, asked: str) -> _Undisturbed:
        if self.textbook or self.load is not None:
            raise ValueError(f"{asked} needs a constant load and the coupled model")
        return self.ball._experiment, self.law._core, self.rolling_below


_places = tuple(dict.fromkeys(event for event, of in _core.event_numbers if of))
_others = (*(event for event, of in _core.event_numbers if not of), "stop_time")
_nested = np.dtype([*((name, [(axis, "f8") for axis in "txy"]) for name in _places), *((name, "f8") for name in _others)])


class _Row(np.void):
    """One row of the events of Rolls: a number by its flat name, or an event."""

    def __getitem__(self, key: Any) -> Any:
        return np.array(self).view(_nested)[key][()] if key in _places else super().__getitem__(key)


class _Events(np.ndarray[Any, Any]):
    """The events of Rolls. The name of an event gives its t, x and y."""

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return super().__getitem__(key)
        plain = self.view(np.ndarray)
        return plain.view(_nested)[key] if key in _places else plain[key]


class Rolls:
    """The motions of one ball from N starts; `Ball.roll` makes them from arrays. Called with times t >= 0 in s of any
    shape S, they return a structured array of shape (N, *S) with the fields of Roll. An index returns one Roll, a slice
    Rolls.

    events:  a structured array of shape (N,) with flat names: rolls_after_t, rolls_after_x, rolls_after_y (s, m), and
             so on for spin_ends and rest (infinite if Roll.rest is None); slip_length, path (m), turns, stop_time (s).
             events["rest"] has the fields t, x, y. rolls_after, spin_ends, rest and the last four are also attributes
    """

    #: The dtype of events.
    dtype = np.dtype((_Row, [*((f"{name}_{axis}", "f8") for name in _places for axis in "txy"),
                             *((name, "f8") for name in _others)]))

    rolls_after: NDArray[np.void]
    spin_ends: NDArray[np.void]
    rest: NDArray[np.void]
    slip_length: NDArray[np.float64]
    turns: NDArray[np.float64]
    path: NDArray[np.float64]
    stop_time: NDArray[np.float64]

    def __init__(self, ball: Ball, starts: NDArray[np.float64], law: Law, rolling_below: float,
                 threads: int = 1, out: Optional[NDArray[Any]] = None) -> None:
        self.ball, self.starts, self.law = ball, np.ascontiguousarray(starts), law
        self.rolling_below, self.threads = rolling_below, threads
        self._core = _core.Shots(ball._experiment, law._core)
        found = self._events(np.empty(len(self), self.dtype) if out is None else target(out, (len(self),), self.dtype))
        self.events: NDArray[np.void] = found.view(_Events)

    def _events(self, out: NDArray[Any]) -> NDArray[Any]:
        into = out if out.flags.c_contiguous else np.empty(len(self), self.dtype)
        self._core.events(self.starts, self.rolling_below, into.view(np.float64), self.threads)
        if into is not out:
            out[...] = into
        return out

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name in (*_places, *_others):
            found: NDArray[Any] = self.events[name]
            return found
        raise AttributeError(f"Rolls has no {name!r}; it has {', '.join((*_places, *_others))}")

    def to_frame(self) -> pandas.DataFrame:
        """Returns the events as a DataFrame of pandas, with a row for each start."""
        import pandas

        return pandas.DataFrame(self.events)

    def __len__(self) -> int:
        return len(self.starts)

    @overload
    def __getitem__(self, row: int) -> Roll: ...
    @overload
    def __getitem__(self, row: slice) -> Rolls: ...
    def __getitem__(self, row: Union[int, slice]) -> Any:
        if isinstance(row, slice):
            return Rolls(self.ball, self.starts[row], *self._again)
        vx, vy, wx, wy, wz = self.starts[whole("row", row)].tolist()
        velocity, angular_velocity = (vx, vy), (wx, wy, wz)
        ball = self.ball.but(velocity=velocity, angular_velocity=angular_velocity)
        return Roll(ball, velocity, angular_velocity, self.law, self.rolling_below)

    def __call__(self, t: ArrayLike) -> NDArray[np.void]:
        times = numbers("t", t)
        return self._core.at(self.starts, times, self.threads).reshape(len(self), *times.shape)

    def __reduce__(self) -> tuple[Any, ...]:
        return Rolls, (self.ball, self.starts, *self._again)

    @property
    def rolling_friction(self) -> float:
        """The rolling friction u_r of the ball."""
        return self.ball.rolling_friction

    @property
    def _again(self) -> tuple[Law, float, int]:
        return self.law, self.rolling_below, self.threads

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, Rolls) and self.ball == other.ball and self._again[:2] == other._again[:2]
                and np.array_equal(self.starts, other.starts))

    def __hash__(self) -> int:
        return hash((self.ball, *self._again[:2], len(self)))

    def __repr__(self) -> str:
        return f"Rolls({len(self)} starts of {self.ball.name!r}, law {self.law.name!r})"
