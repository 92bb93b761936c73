"""Balls in SI units."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, fields
from functools import cached_property, lru_cache
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._law import Law, LawLike, body_of, law as law_of
from ._numbers import needs, number, numbers, target, text, thread_count, whole


class Event(NamedTuple):
    """When something happens, in s after the start, and where the centre is then, in m from the start."""

    t: float
    x: float
    y: float


@dataclass(frozen=True)
class Ball:
    """A ball on a plane, or a body that lies flat on it, in SI units, with a typical start.

    mass may be None, that is not known. The energies of a motion are then nan. A load, moduli, a stroke and engines need it.
    Its patch is given by one of patch_radius (m), spin_deceleration (rad/s^2, measured without slip), or Young's moduli
    (Pa) and Poisson's ratios of ball and plane, with counter_radius (m) where it is no plane: of another ball above 0, of a
    dish below 0; it changes the patch alone. What presses it on the plane is gravity (m/s^2, 9.80665 if left out), or a
    load (N). Its start, at rest if left out, is slip (m/s, along x) and spin (rad/s about the vertical), or velocity (x, y)
    and angular_velocity (x, y, z up). Of a start by velocities slip and spin, and of a load gravity, say what they come to.
    rolling_friction: rolling without slip, the ball slows down at so much of gravity. slope: degrees by which the plane
    rises along x, negative where it falls. law is that of every question
    about the ball that names none: a name, a Law or a function; that of the body if left out.
    body: ball, hollow-ball; or disc (puck) and ring, which lie flat and turn about the vertical only. Their patch is the
    whole face, of the body's radius, if none is given. inertia: over m R^2, in place of that of the body's name.
    uncertainty: what its numbers are known to, as the table of a run file: standard deviations by name, {"friction": 0.01,
    "patch_radius": 1e-4}, vx, vy, wx, wy, wz of velocities, and how they go together under "correlation":
    {"patch_radius": {"friction": -0.7}}. A number that `but` replaces is known.
    `Ball.pool()` and the others are those of `contensou balls`; what is named in the call replaces theirs.
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
        """The fields that say all."""
        derived = {"gravity"} if self.load is not None else set()
        if self.velocity is not None:
            derived |= {"slip", "spin"}
        if self.law == law_of(self._experiment.law):
            derived |= {"law"}
        known = {each.name: getattr(self, each.name) for each in fields(self) if each.init and each.name not in derived}
        return {name: value for name, value in known.items() if value is not None}

    def __reduce__(self) -> tuple[Any, ...]:
        return Ball._of, (self._given(), {})

    @classmethod
    def _of(cls, known: dict[str, Any], changes: dict[str, Any]) -> Ball:
        law = {"law": changes.get("law", known.get("law"))}
        allowed = [each.name for each in fields(cls) if each.init]
        for key in changes.keys() - set(allowed):
            raise TypeError(f"a Ball has no {key}; it has {', '.join(allowed)}")
        return cls(**_core.changed(known, changes), **law)

    def but(self, **changes: Any) -> Ball:
        """The ball with other fields. What was given in another way goes: a new patch_radius, spin_deceleration or moduli
        take the place of what it had, a load that of gravity, slip with spin that of velocities."""
        return self._of(self._given(), changes)

    @classmethod
    def read(cls, path: Union[str, PathLike[str]], **changes: Any) -> Ball:
        """The ball of a run file (TOML), as `contensou balls pool -o mine.toml` writes one."""
        return cls._of(_core.parse_run_file(Path(path).read_text(encoding="utf-8"), str(path)), changes)

    def write(self, path: Union[str, PathLike[str]]) -> None:
        """Writes the ball as a run file (TOML), which `read` and `contensou --ball` take: name, cloth, start and law.
        Raises ValueError for a law that no file can name, one that is a function or a table."""
        name = law_of(self.law).name
        try:
            known = law_of(name)
        except ValueError:
            known = None
        if known != self.law:
            raise ValueError(f"law {name!r}: a run file has the name of a law, or its formulas")
        Path(path).write_text(_core.run_file(self._experiment, name), encoding="utf-8")

    @classmethod
    def named(cls, name: str, /, **changes: Any) -> Ball:
        """The ball that `contensou balls` lists by that name."""
        return cls._of(_core.ball(text("name", name)), changes)

    @classmethod
    def pool(cls, **changes: Any) -> Ball:
        """A pool ball on cloth."""
        return cls.named("pool", **changes)

    @classmethod
    def steel(cls, **changes: Any) -> Ball:
        """A steel ball of 20 mm on glass."""
        return cls.named("steel", **changes)

    @classmethod
    def bowling(cls, **changes: Any) -> Ball:
        """A bowling ball on a dry lane."""
        return cls.named("bowling", **changes)

    @classmethod
    def rubber(cls, **changes: Any) -> Ball:
        """A rubber ball on steel."""
        return cls.named("rubber", **changes)

    @classmethod
    def gel(cls, **changes: Any) -> Ball:
        """A gel ball on a rigid plane, where sliding and spinning are seen to be coupled."""
        return cls.named("gel", **changes)

    @classmethod
    def basketball(cls, **changes: Any) -> Ball:
        """A basketball on a wooden floor, a hollow ball."""
        return cls.named("basketball", **changes)

    @classmethod
    def puck(cls, **changes: Any) -> Ball:
        """An ice hockey puck, a disc that lies flat."""
        return cls.named("puck", **changes)

    def mu(self, law: Optional[LawLike] = None) -> float:
        """Patch radius over radius."""
        return _solved(self, self._law(law)).mu

    def _law(self, asked: Optional[LawLike]) -> Law:
        """The law that was asked for, or the ball's own."""
        return law_of(self.law if asked is None else asked)

    def roll(
        self,
        *,
        velocity: Optional[ArrayLike] = None,
        angular_velocity: Optional[ArrayLike] = None,
        slip: Optional[ArrayLike] = None,
        spin: Optional[ArrayLike] = None,
        strike: Optional[ArrayLike] = None,
        tip: Optional[ArrayLike] = None,
        elevation: Optional[ArrayLike] = None,
        cue_mass: Optional[ArrayLike] = None,
        law: Optional[LawLike] = None,
        rolling_below: Optional[float] = None,
        rolling_friction: Optional[float] = None,
        load: Optional[tuple[ArrayLike, ArrayLike]] = None,
        threads: int = 1,
        out: Optional[NDArray[Any]] = None,
    ) -> Any:
        """The whole motion of the ball, or of the body that lies flat, from its own start or from another one, as a Roll;
        of N starts at once, where one of these has an axis of N more, as Rolls:

        velocity, angular_velocity:  of the centre, (x, y) or (x, y, 0) in m/s, and of the ball, (x, y, z) in rad/s, z up
        slip, spin:                  m/s along x, rad/s about the vertical
        strike:                      a cue of this speed in m/s strikes the ball at rest, along x; tip is where, to the
                                     right of and above the centre in radii, (0, 0); elevation of its butt in degrees, 0;
                                     cue_mass, 0.54 kg

        law:               that of the ball if left out
        rolling_below:     the ball rolls once it slips slower, 0.001 m/s; not of a body that lies flat
        rolling_friction:  u_r: rolling without slip it slows down at u_r g; 0: it rolls on. That of the ball if left out
        load:              one that changes: instants in s from 0 on, and newtons at each, linear between them and the last
                           one from then on. The patch does not change with it; friction is all that acts
        threads, out:      of N starts; an array for their events, of shape (N,) and dtype Rolls.dtype
        Raises ValueError for what no ball can be or do, naming the row.
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
        friction = self.rolling_friction if rolling_friction is None else number("rolling_friction", rolling_friction)
        count = _count(start)
        if count is None:
            if threads != 1 or out is not None:
                raise ValueError("threads and out are of an array of starts; this is one")
            ball = self if strike is not None else self.but(**{name: value.tolist() for name, value in start.items()})
            history = None
            if load is not None:
                history, ball = ball._under(load, friction)
            core = ball._experiment
            if strike is not None:
                core = core.struck(*(value.tolist() for value in start.values()))
                ball = ball.but(velocity=core.start[0], angular_velocity=core.start[1])
            return Roll(ball, *core.start, ball._law(law), below, friction, load=history)
        if load is not None:
            raise ValueError("load: one that changes is of one start, these are several")
        if strike is not None:
            columns = [np.broadcast_to(value, (count, *_widths[name][0])) for name, value in start.items()]
            starts = _core.struck_starts(self._experiment, np.column_stack(columns))
        else:
            starts = self._starts(start, count)
        return Rolls(self, starts, self._law(law), below, friction, thread_count(threads), out)

    def _starts(self, given: dict[str, NDArray[np.float64]], count: int) -> NDArray[np.float64]:
        """Rows vx, vy, wx, wy, wz. What is not given is the ball's own, as `but` has it."""
        if {"slip", "spin"} & given.keys() and {"velocity", "angular_velocity"} & given.keys():
            raise ValueError("slip, spin and velocity, angular_velocity exclude each other: keep one kind of start")
        if count == 0:
            return np.empty((0, 5))
        if "slip" in given:
            bad = np.flatnonzero(~(given["slip"] >= 0))
            if bad.size:
                raise ValueError(f"row {bad[0]}: slip: 0 or more is needed, got {given['slip'].flat[bad[0]]}")
        rest = {"velocity": (0, 0), "angular_velocity": (0, 0, 0), "slip": 0, "spin": 0}
        own = self.but(**{name: rest[name] for name in given})
        starts = np.empty((count, 5))
        velocity, angular_velocity = own._experiment.start
        starts[:, :2], starts[:, 2:] = velocity, angular_velocity
        for name, columns in (("velocity", slice(0, 2)), ("angular_velocity", slice(2, 5)), ("slip", 0), ("spin", 4)):
            if name in given:
                starts[:, columns] = given[name]
        return starts

    def _under(self, load: tuple[ArrayLike, ArrayLike], friction: float) -> tuple[Any, Ball]:
        """A load that changes, as two tuples, and this ball under its nominal one."""
        if not isinstance(load, (tuple, list, np.ndarray)) or len(load) != 2:
            raise needs("load", "(instants in s, newtons at each)", load)
        t, newtons = (tuple(np.atleast_1d(numbers("load", each)).tolist()) for each in load)
        ball = self.but(load=_core.LoadHistory(list(t), list(newtons)).nominal)
        if ball.youngs_modulus is not None:
            raise ValueError("load: the patch of Young's moduli grows with a load that changes, and the motion is then "
                             "no other one's copy: give patch_radius")
        if ball.slope or friction:
            raise ValueError("load: one that changes is of friction alone: leave out slope and rolling_friction")
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
        """The state of a ball on the table t seconds later, in the convention of pooltool: rows r, v and w, the place of
        the centre in m, its velocity in m/s and the angular velocity in rad/s, z up. t >= 0 of any shape S: (*S, 3, 3);
        of N balls, (N, 3, 3): (N, *S, 3, 3). A new array."""
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


def a_ball(given: Any) -> Ball:
    if not isinstance(given, Ball):
        raise TypeError(f"ball: a Ball is needed, as Ball.pool(); got {given!r:.60}")
    return given


def balls() -> dict[str, Ball]:
    """The built-in balls by their names, as `contensou balls` lists them."""
    return {name: Ball.named(name) for name in _core.balls}


_flat = ("disc", "ring")

#: Of what a start is given by the shape of one, and how many numbers each may have.
_widths: dict[str, tuple[tuple[int, ...], tuple[int, ...]]] = {
    "velocity": ((2,), (2, 3)), "angular_velocity": ((3,), (3,)), "slip": ((), ()), "spin": ((), ()),
    "strike": ((), ()), "tip": ((2,), (2,)), "elevation": ((), ()), "cue_mass": ((), ()),
}

#: Of a stroke what it is unless it is given, in the order of _core; strike always is.
_stroke = {"strike": np.array(np.nan), "tip": np.zeros(2), "elevation": np.array(0.0), "cue_mass": np.array(_core.standard_cue_mass)}


def _rows(name: str, given: ArrayLike, one: tuple[int, ...], widths: tuple[int, ...]) -> NDArray[np.float64]:
    """One of them, or N.
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
    """How many starts; None: one."""
    counts = {name: value.shape[0] for name, value in start.items() if value.ndim > len(_widths[name][0])}
    if len(set(counts.values())) > 1:
        raise ValueError(f"as many of each are needed, got {', '.join(f'{count} of {name}' for name, count in counts.items())}")
    return next(iter(counts.values()), None)


@lru_cache(maxsize=64)
def _solved(ball: Ball, law: Law) -> _core.Flow:
    return ball._experiment.undriven_flow(law._core)


_Undisturbed = tuple[_core.Experiment, _core.Law, float]  # of no class: there _core is its own


@dataclass(frozen=True)
class Roll:
    """The motion of a ball: called with times t >= 0 in s, of any shape, it gives a structured array of that shape with
    fields t, x, y, vx, vy, wx, wy, wz, slip, energy (s, m, m/s, rad/s, J). The centre starts at (0, 0). `Ball.roll` makes one."""

    ball: Ball
    velocity: tuple[float, float]
    angular_velocity: tuple[float, float, float]
    law: Law
    rolling_below: float
    rolling_friction: float
    textbook: bool = False
    load: Optional[tuple[tuple[float, ...], tuple[float, ...]]] = None
    _core: _core.Motion = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        experiment = self.ball.but(velocity=self.velocity, angular_velocity=self.angular_velocity)._experiment
        load = None if self.load is None else _core.LoadHistory(list(self.load[0]), list(self.load[1]))
        if self.textbook:
            core = _core.Motion.uncoupled(experiment, self.law._core, self.rolling_friction, load, self.rolling_below)
        else:
            core = _core.Motion.reduced(experiment, _solved(self.ball.but(slip=0, spin=0), self.law), self.rolling_friction, load)
        object.__setattr__(self, "_core", core)

    def __reduce__(self) -> tuple[Any, ...]:
        return Roll, tuple(getattr(self, each.name) for each in fields(self) if each.init)

    def __call__(self, t: ArrayLike) -> Any:
        return self._core.at(numbers("t", t))[()]

    def plot(self, axes: Any = None, until: Optional[float] = None) -> Any:
        """The path on the table, to scale, and the speeds against time, beside the textbook's, dashed, by matplotlib into
        two axes, or into a new figure. until: s; if left out until a little after it rolls.
        Gives the axes."""
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

    @property
    def uncoupled(self) -> Roll:
        """The textbook's ball, whose sliding and spinning do not know of each other, from the same start."""
        return Roll(self.ball, self.velocity, self.angular_velocity, self.law, self.rolling_below, self.rolling_friction, True, self.load)

    @property
    def rolls_after(self) -> Event:
        """When its slip has fallen to rolling_below; of a body that lies flat when it rests."""
        return Event(*self._core.rolls_after(self.rolling_below))

    @property
    def spin_ends(self) -> Event:
        """When it no longer spins; at the start without spin."""
        return Event(*self._core.spin_ends)

    @property
    def rest(self) -> Optional[Event]:
        """When its centre rests, with rolling friction or on a slope; None where it rolls on for ever, and of a body that lies
        flat on a level plane, whose rest is its rolls_after."""
        rest = self._core.rest
        return None if rest is None else Event(*rest)

    @property
    def stop_time(self) -> float:
        """s until slip and spin end."""
        return self._core.stop_time

    @cached_property
    def slip_length(self) -> float:
        """m that the contact point slides."""
        return self._core.slip_length

    @cached_property
    def turns(self) -> float:
        """Turns about the vertical until the spin ends."""
        return self._core.turns

    @cached_property
    def path(self) -> float:
        """m along the path of the centre until it rolls."""
        return self._core.path(self.rolling_below)

    def uncertainty(self, *own: str, **spreads: Union[str, float]) -> dict[str, Any]:
        """What the events are known to, where numbers of the ball or of its start are known to a standard deviation each:
        `roll.uncertainty(slip="1%", spin="2 rad/s", friction=0.01)`, or vx, vy, wx, wy, wz of a start by velocities.
        `roll.uncertainty("fit")` takes what the ball itself is known to (Ball.uncertainty); what is named beside it replaces it.

        The member uncertainty of `contensou roll --uncertainty --format json`: of each number of an event standard, to first
        order, shares of it by name, quantiles of 10 000 samples, and first_order_holds, whether these agree.
        Raises ValueError for what has no spread or is no spread, a load that changes, and the textbook's ball.
        """
        typed = ",".join([*(text("uncertainty", each) for each in own),
                          *(f"{name}={spread if isinstance(spread, str) else repr(number(name, spread))}" for name, spread in spreads.items())])
        found: dict[str, Any] = json.loads(_core.roll_uncertainty(*self._undisturbed("uncertainty"), typed))
        return found

    def gradient(self) -> dict[str, Any]:
        """How each number of an event changes with each number of the ball and of its start, the others kept, in SI units:
        `roll.gradient()["rolls_after"]["t"]["friction"]`, the member gradient of `contensou roll --gradient --format json`.
        A number at which the events have a corner, as a spin of 0, is left out. By differences of fourth order: to 1e-8,
        less sharp of a motion with rolling friction or on a slope that is integrated in steps.
        """
        found: dict[str, Any] = json.loads(_core.roll_gradient(*self._undisturbed("gradient")))
        return found

    def _undisturbed(self, asked: str) -> _Undisturbed:
        if self.textbook or self.load is not None:
            raise ValueError(f"{asked} is of this motion under a constant load, and not of the textbook's")
        return self.ball.but(rolling_friction=self.rolling_friction)._experiment, self.law._core, self.rolling_below


_place = [("t", "f8"), ("x", "f8"), ("y", "f8")]


class Rolls:
    """The motions of one ball from N starts; `Ball.roll` makes them of arrays. Called with times t >= 0 in s, of any shape
    S, they give a structured array of shape (N, *S) with the fields of Roll; an index gives one Roll, a slice Rolls.

    events:  a structured array of shape (N,): rolls_after, spin_ends and rest, each with t, x, y (s, m), as Roll has them, rest
             infinite where that is None; slip_length, path (m), turns, stop_time (s). Each is an attribute, too.
    """

    #: Of events.
    dtype = np.dtype([("rolls_after", _place), ("spin_ends", _place), ("rest", _place), ("slip_length", "f8"), ("turns", "f8"),
                      ("path", "f8"), ("stop_time", "f8")])

    def __init__(self, ball: Ball, starts: NDArray[np.float64], law: Law, rolling_below: float, rolling_friction: float,
                 threads: int = 1, out: Optional[NDArray[Any]] = None) -> None:
        self.ball, self.starts, self.law = ball, np.ascontiguousarray(starts), law
        self.rolling_below, self.rolling_friction, self.threads = rolling_below, rolling_friction, threads
        self._core = _core.Shots(ball._experiment, law._core, rolling_friction)
        self.events = self._events(np.empty(len(self), self.dtype) if out is None else target(out, (len(self),), self.dtype))

    def _events(self, out: NDArray[Any]) -> NDArray[Any]:
        into = out if out.flags.c_contiguous else np.empty(len(self), self.dtype)
        self._core.events(self.starts, self.rolling_below, into.view(np.float64), self.threads)
        if into is not out:
            out[...] = into
        return out

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name in (Rolls.dtype.names or ()):
            return self.events[name]
        raise AttributeError(f"Rolls has no {name!r}; it has {', '.join(Rolls.dtype.names or ())}")

    def __len__(self) -> int:
        return len(self.starts)

    def __getitem__(self, row: Union[int, slice]) -> Any:
        if isinstance(row, slice):
            return Rolls(self.ball, self.starts[row], *self._again)
        vx, vy, wx, wy, wz = self.starts[whole("row", row)].tolist()
        velocity, angular_velocity = (vx, vy), (wx, wy, wz)
        ball = self.ball.but(velocity=velocity, angular_velocity=angular_velocity)
        return Roll(ball, velocity, angular_velocity, self.law, self.rolling_below, self.rolling_friction)

    def __call__(self, t: ArrayLike) -> NDArray[Any]:
        times = numbers("t", t)
        return self._core.at(self.starts, times, self.threads).reshape(len(self), *times.shape)

    def __reduce__(self) -> tuple[Any, ...]:
        return Rolls, (self.ball, self.starts, *self._again)

    @property
    def _again(self) -> tuple[Law, float, float, int]:
        return self.law, self.rolling_below, self.rolling_friction, self.threads

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, Rolls) and self.ball == other.ball and self._again[:3] == other._again[:3]
                and np.array_equal(self.starts, other.starts))

    def __hash__(self) -> int:
        return hash((self.ball, *self._again[:3], len(self)))

    def __repr__(self) -> str:
        return f"Rolls({len(self)} starts of {self.ball.name!r}, law {self.law.name!r})"
