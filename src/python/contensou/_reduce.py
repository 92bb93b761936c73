"""The symmetries of a planar system, found, and the motions that they solve."""

from __future__ import annotations

from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._flow import Flow
from ._numbers import numbers


class Generator(NamedTuple):
    """X = c t d/dt + (A x + b) . d/dx, x = (u, v); its largest entry is 1."""

    time: float
    matrix: NDArray[np.float64]
    shift: NDArray[np.float64]


class PlanarRay(NamedTuple):
    """A direction that orbits keep; radial and angular are the eigenvalues along it and across."""

    angle: float
    attracts: bool
    to_centre: bool
    radial: float
    angular: float


class SingularPoint(NamedTuple):
    """A singular point of Zhuravlev's plane, at the origin or at infinity, and its eigenvalues."""

    half_line: str
    place: str
    k: float
    q: float
    radial: float
    angular: float
    kind: str


class Reduction:
    """What `reduce` found.

    generators:       all of the form c t d/dt + (A x + b) . d/dx, the one that solves the system first; none: ()
    singular_values:  of the determining equations, ascending, relative to the largest; below level they count as 0
    gap:              how far those that count as 0 are from the others
    verdict:          found, none, or undecided: the field's noise hides what a generator would leave
    solved:           whether a generator is a scaling; else what follows raises ValueError

    Points are numbers, or arrays of shapes that broadcast; NaN where there is no answer.
    """

    def __init__(self, core: _core.Planar) -> None:
        self._core = core
        self.generators = tuple(Generator(*x) for x in core.generators)
        self.singular_values = np.array(core.singular_values)
        self.level = core.level
        self.gap = core.gap
        self.verdict = core.verdict
        self.solved = core.solved

    def __repr__(self) -> str:
        return f"<reduction: {self.kind}>" if self.solved else f"<reduction: {len(self.generators)} generators, no scaling>"

    @property
    def generator(self) -> Generator:
        """The first of them. Raises ValueError if there is none."""
        if self.generators:
            return self.generators[0]
        raise ValueError(f"no generator of this form, or none that is known: the verdict is {self.verdict}")

    @property
    def kind(self) -> str:
        """Of the blown-up centre: stable node, saddle, stable focus, ..."""
        return self._core.kind

    @property
    def rays(self) -> tuple[PlanarRay, ...]:
        return tuple(PlanarRay(*ray) for ray in self._core.rays)

    @property
    def turn(self) -> Optional[tuple[float, float]]:
        """Of a focus: the factor of exp(p) in a turn, and its length in sigma, d sigma = exp(-c p) dt."""
        return self._core.turn

    def canonical(self, u: ArrayLike, v: ArrayLike) -> tuple[Any, Any]:
        """q, the angle, and p, which alone the symmetry moves: ln of the distance over that of the start given to reduce."""
        q, p = self._core.canonical(*_points(u, v))
        return q[()], p[()]

    def first_integral(self, u: ArrayLike, v: ArrayLike) -> Any:
        """The same number along an orbit; NaN on rays."""
        return self._core.first_integral(*_points(u, v))[()]

    def stop_time(self, *, u: ArrayLike, v: ArrayLike) -> Any:
        """The time to the centre, relative 1e-12; inf if it is not reached."""
        return self._core.stop_time(*_points(u, v))[()]

    def at(self, t: ArrayLike, *, u: float, v: float) -> tuple[Any, Any]:
        """u and v at times t >= 0 after the start (u, v)."""
        us, vs = self._core.at(u, v, numbers("t", t))
        return us[()], vs[()]


class FlowReduction(Reduction):
    """Of Zhuravlev's system, in the paper's coordinates: q = v/u and p = ln v; the first integral is ln |u| - ln w(k)."""

    def __init__(self, flow: Flow) -> None:
        super().__init__(_core.Planar.of_flow(flow._core))
        self._flow = flow

    def canonical(self, u: ArrayLike, v: ArrayLike) -> tuple[Any, Any]:
        u, v = _points(u, v)
        with np.errstate(divide="ignore", invalid="ignore"):
            return (v / u)[()], np.log(v)[()]

    def first_integral(self, u: ArrayLike, v: ArrayLike) -> Any:
        return self._flow._core.first_integral(*_points(u, v))[()]


def _points(u: ArrayLike, v: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    us, vs = np.broadcast_arrays(numbers("u", u), numbers("v", v))
    return us, vs


def reduce(
    system: Union[str, Callable[[float, float], tuple[float, float]]], *, u: float, v: float, **parameters: float
) -> Reduction:
    """The scaling symmetries of u' = F(u, v), v' = G(u, v), and the system solved by them, without steps in time.

    system:      a function (u, v) -> (u', v'), or its formulas "u' = F; v' = G"; an exception, NaN and inf stand for
                 points without a value
    u, v:        a start, not 0: its size is the scale at which the field is sampled
    parameters:  of the formulas
    """
    if isinstance(system, str):
        return Reduction(_core.Planar.of_text(system, parameters, u, v))
    if parameters:
        raise TypeError(f"reduce: a function has its parameters itself, got {', '.join(parameters)}")
    return Reduction(_core.Planar.of_function(system, u, v))
