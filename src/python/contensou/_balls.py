"""Balls in SI units."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import cached_property, lru_cache
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._numbers import numbers
from ._flow import Flow, Law, LawLike, law as law_of


class Event(NamedTuple):
    """When something happens, in s after the start, and where the centre is then, in m from the start."""

    t: float
    x: float
    y: float


@dataclass(frozen=True)
class Ball:
    """A ball on a plane, or a body that lies flat on it, in SI units, with a typical start.

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
    `Ball.pool()` and the others are those of `contensou balls`; what is named in the call replaces theirs.
    """

    mass: float
    radius: float
    friction: float
    patch_radius: Optional[float] = None
    spin_deceleration: Optional[float] = None
    youngs_modulus: Optional[tuple[float, float]] = None
    poisson_ratio: Optional[tuple[float, float]] = None
    gravity: float = None  # type: ignore[assignment]  # never after __init__
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
    _experiment: _core.Experiment = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        given = {name: getattr(self, name) for name in ("name", "body", *_core.quantities)}
        known = _core.changed({}, given)
        core = _core.Experiment(known)
        if self.velocity is not None or self.angular_velocity is not None:
            known["velocity"], known["angular_velocity"] = core.start
        derived = {"gravity": core.gravity, "slip": core.slip, "spin": core.spin}
        law = law_of(core.law if self.law is None else self.law)
        for key, value in {**derived, **known, "law": law, "_experiment": core}.items():
            object.__setattr__(self, key, value)

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

    @classmethod
    def named(cls, name: str, **changes: Any) -> Ball:
        """The ball that `contensou balls` lists by that name."""
        return cls._of(_core.ball(name), changes)

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
        slip: Optional[float] = None,
        spin: Optional[float] = None,
        strike: Optional[float] = None,
        tip: tuple[float, float] = (0, 0),
        elevation: float = 0,
        cue_mass: float = _core.standard_cue_mass,
        law: Optional[LawLike] = None,
        rolling_below: float = _core.rolling_slip,
        rolling_friction: Optional[float] = None,
        load: Optional[tuple[ArrayLike, ArrayLike]] = None,
    ) -> Roll:
        """The whole motion of the ball, or of the body that lies flat, from its own start or from another one:

        velocity, angular_velocity:  of the centre, (x, y) in m/s, and of the ball, (x, y, z) in rad/s, z up
        slip, spin:                  m/s along x, rad/s about the vertical
        strike:                      a cue of this speed in m/s strikes the ball at rest, along x; tip is where, to the
                                     right of and above the centre in radii; elevation of its butt in degrees; cue_mass, kg

        law:               that of the ball if left out
        rolling_below:     the ball rolls once it slips slower, m/s
        rolling_friction:  u_r: rolling without slip it slows down at u_r g; 0: it rolls on. That of the ball if left out
        load:              one that changes: instants in s from 0 on, and newtons at each, linear between them and the last
                           one from then on. The patch does not change with it; friction is all that acts
        """
        start = {"velocity": velocity, "angular_velocity": angular_velocity, "slip": slip, "spin": spin}
        start = {name: value for name, value in start.items() if value is not None}
        if strike is not None and start:
            raise ValueError(f"strike is a start of its own: leave out {', '.join(start)}")
        ball = self.but(**start)
        history = None
        if load is not None:
            t, newtons = (tuple(np.atleast_1d(numbers("load", each)).tolist()) for each in load)
            history = t, newtons
            ball = ball.but(load=_core.LoadHistory(list(t), list(newtons)).nominal)
            if ball.youngs_modulus is not None:
                raise ValueError("load: the patch of Young's moduli grows with a load that changes, and the motion is then "
                                 "no other one's copy: give patch_radius")
            if ball.slope or (ball.rolling_friction if rolling_friction is None else rolling_friction):
                raise ValueError("load: one that changes is of friction alone: leave out slope and rolling_friction")
        core = ball._experiment if strike is None else ball._experiment.struck(strike, tip, elevation, cue_mass)
        friction = ball.rolling_friction if rolling_friction is None else rolling_friction
        return Roll(ball, *core.start, ball._law(law), rolling_below, friction, load=history)

    def evolve(
        self,
        rvw: ArrayLike,
        t: ArrayLike,
        *,
        law: Optional[LawLike] = None,
        rolling_below: float = _core.rolling_slip,
        rolling_friction: Optional[float] = None,
    ) -> NDArray[np.float64]:
        """The state of a ball on the table t seconds later, in the convention of pooltool: rows r, v and w, the place of
        the centre in m, its velocity in m/s and the angular velocity in rad/s, z up. t >= 0 of any shape S: (*S, 3, 3).
        A new array."""
        rvw = numbers("rvw", rvw)
        if rvw.shape != (3, 3) or rvw[1, 2] != 0:
            raise ValueError(f"rvw: rows r, v, w of a ball on the table, shape (3, 3) with v_z = 0; got {rvw.tolist()}")
        roll = self.roll(velocity=rvw[1, :2], angular_velocity=rvw[2], law=law,
                         rolling_below=rolling_below, rolling_friction=rolling_friction)
        at = np.asarray(roll(t))
        result = np.zeros((*at.shape, 3, 3))
        for row, column, name in ((0, 0, "x"), (0, 1, "y"), (1, 0, "vx"), (1, 1, "vy"), (2, 0, "wx"), (2, 1, "wy"), (2, 2, "wz")):
            result[..., row, column] = at[name]
        result[..., 0, :] += rvw[0]
        return result


@lru_cache(maxsize=64)
def _solved(ball: Ball, law: Law) -> _core.Flow:
    return ball._experiment.undriven_flow(law._core)


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
    _core: Union[_core.BallMotion, _core.UncoupledMotion] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        experiment = self.ball.but(velocity=self.velocity, angular_velocity=self.angular_velocity)._experiment
        load = None if self.load is None else _core.LoadHistory(list(self.load[0]), list(self.load[1]))
        settings = self.rolling_below, self.rolling_friction, load
        if self.textbook:
            core: Union[_core.BallMotion, _core.UncoupledMotion] = _core.UncoupledMotion(experiment, self.law._core, *settings)
        else:
            core = _core.BallMotion(experiment, _solved(self.ball.but(slip=0, spin=0), self.law), *settings)
        object.__setattr__(self, "_core", core)

    def __reduce__(self) -> tuple[Any, ...]:
        return Roll, tuple(getattr(self, each.name) for each in fields(self) if each.init)

    def __call__(self, t: ArrayLike) -> Any:
        return self._core.at(numbers("t", t))[()]

    @property
    def uncoupled(self) -> Roll:
        """The textbook's ball, whose sliding and spinning do not know of each other, from the same start."""
        return Roll(self.ball, self.velocity, self.angular_velocity, self.law, self.rolling_below, self.rolling_friction, True, self.load)

    @property
    def rolls_after(self) -> Event:
        """When its slip has fallen to rolling_below; of a body that lies flat when it rests."""
        return Event(*self._core.rolls_after)

    @property
    def spin_ends(self) -> Event:
        """When it no longer spins; at the start without spin."""
        return Event(*self._core.spin_ends)

    @property
    def rest(self) -> Optional[Event]:
        """When its centre rests, with rolling friction or on a slope; None where it rolls on for ever."""
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
        return self._core.path
