"""The symmetries of a planar system, found, and the motions that they solve."""

from __future__ import annotations

from typing import Any, Callable, Iterable, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._numbers import needs, number, numbers, together
from ._portrait import Portrait, points_of, start_of


class Generator(NamedTuple):
    """X = c t d/dt + (A x + b) . d/dx, x = (u, v); its largest entry is 1. Where not `everywhere`, it maps the field onto
    itself within each sector in which that is smooth, and not across their borders."""

    time: float
    matrix: NDArray[np.float64]
    shift: NDArray[np.float64]
    everywhere: bool = True


class PlanarRay(NamedTuple):
    """A direction that orbits keep; radial and angular are the eigenvalues along it and across."""

    angle: float
    attracts: bool
    to_centre: bool
    radial: float
    angular: float


class Reduction:
    """What `reduce` found.

    generators:       all of the form c t d/dt + (A x + b) . d/dx, the one that solves the system first; none: ()
    singular_values:  of the determining equations, ascending, relative to the largest; below level they count as 0
    gap:              how far those that count as 0 are from the others
    verdict:          found, none, or undecided: the field's noise hides what a generator would leave
    solved:           True if a scaling, or an inverse integrating factor alone, solves it; else what follows raises
                      ValueError
    form:             how it is solved: "scaling", or the form of the factor, such as "polynomial"; else None
    tried:            forms of the factor that were tried: (form, least singular value, gap, residual)

    It keeps the system: orbit and portrait are its motions.
    Points are numbers, or arrays of shapes that broadcast; NaN where there is no answer.
    """

    def __init__(self, core: _core.Planar, system: str, start: Optional[tuple[float, float]], again: tuple[Any, ...]) -> None:
        self._core, self._system, self._start, self._again = core, system, start, again
        self.generators = tuple(Generator(*x) for x in core.generators)
        self.singular_values = np.array(core.singular_values)
        self.level = core.level
        self.gap = core.gap
        self.verdict = core.verdict
        self.solved = core.solved
        self.form: Optional[str] = core.form
        self.tried: tuple[tuple[str, float, float, float], ...] = tuple(core.tried)

    def __reduce__(self) -> tuple[Any, ...]:
        return self._again

    def __repr__(self) -> str:
        if self.solved:
            return f"<reduction: {self.kind if self.form == 'scaling' else self.form}>"
        return f"<reduction: {len(self.generators)} generators, no factor>"

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

    def factor(self, u: ArrayLike, v: ArrayLike) -> Any:
        """An inverse integrating factor V, for which f . grad V = V div f; NaN where it is not known."""
        return self._core.factor(*together(u=u, v=v))[()]

    @property
    def rays(self) -> tuple[PlanarRay, ...]:
        return tuple(PlanarRay(*ray) for ray in self._core.rays)

    @property
    def turn(self) -> Optional[tuple[float, float]]:
        """Of a focus: the factor of exp(p) in a turn, and its length in sigma, d sigma = exp(-c p) dt."""
        return self._core.turn

    def canonical(self, u: ArrayLike, v: ArrayLike) -> tuple[Any, Any]:
        """q, the angle, and p, which alone the symmetry moves: ln of the distance over that of the start given to reduce."""
        q, p = self._core.canonical(*together(u=u, v=v))
        return q[()], p[()]

    def first_integral(self, u: ArrayLike, v: ArrayLike) -> Any:
        """The same number along an orbit; NaN on rays."""
        return self._core.first_integral(*together(u=u, v=v))[()]

    def stop_time(self, *, u: ArrayLike, v: ArrayLike) -> Any:
        """The time to the centre, relative 1e-12; inf if it is not reached; NaN beyond a border of the field, or a jump."""
        return self._core.stop_time(*together(u=u, v=v))[()]

    def orbit(self, u: float, v: float) -> PlanarOrbit:
        """The motion from one start."""
        return PlanarOrbit(self, number("u", u), number("v", v))

    def portrait(
        self,
        *,
        u: Optional[float] = None,
        v: Optional[float] = None,
        window: Union[None, tuple[float, float], tuple[tuple[float, float], tuple[float, float]]] = None,
        orbits: Optional[int] = None,
        through: Iterable[tuple[float, float]] = (),
        isochrones: Union[None, int, Sequence[float]] = None,
        arrows: str = "time",
        field: str = "none",
        axes: bool = True,
        colour: str = "time",
        style: str = "print",
        size: Union[None, str, tuple[float, float]] = None,
        title: Optional[str] = None,
        font: str = "",
        dpi: float = 300,
    ) -> Portrait:
        """The plane with orbits, rays and isochrones, as `contensou portrait --system` draws it.

        u, v:        the start of an orbit to be highlighted; the start given to reduce if left out
        window:      (U, V), about the centre, or ((U1, U2), (V1, V2)); else a square with the start and all points in it
        orbits:      so many, else as many as fill the window
        through:     points (u, v) whose orbits are shown, too
        isochrones:  about so many lines of equal time left; or their times
        field:       none or motion; axes: the rays; arrows, colour, style, size, title, font, dpi: as of contensou.portrait
        """
        asked: dict[str, Any] = dict(locals(), through=points_of(through))
        asked["reduction"] = asked.pop("self")
        if u is None and v is None and self._start is not None:
            asked["u"], asked["v"] = self._start
        return Portrait(_of_plane, asked)


def _of_plane(asked: dict[str, Any]) -> _core.Portrait:
    reduction = asked["reduction"]
    return _core.Portrait.of_plane(
        reduction._core, reduction._system, start_of(asked),
        **{key: asked[key] for key in ("window", "orbits", "through", "isochrones", "arrows", "field", "axes", "colour",
                                       "style", "size", "title")},
    )


class PlanarOrbit:
    """One motion: Reduction.orbit makes it.

    end:        centre, infinity, rest (a point that is none of both), border (of the field, or a jump), periodic,
                equilibrium or cycle (which it nears for ever); None if it is not decided
    end_time:   when it is there, by quadrature, relative 1e-12; inf if that takes for ever, or is not known
    stop_time:  when it is at the centre; inf if it never is; NaN if it comes to a border
    period:     of a motion that returns; else None
    """

    def __init__(self, reduction: Reduction, u: float, v: float) -> None:
        self.reduction, self.u, self.v = reduction, u, v
        self._core = reduction._core.orbit(u, v)
        self.end, self.end_time, self.stop_time = self._core.end, self._core.end_time, self._core.stop_time
        self.period: Optional[float] = self._core.period

    def __reduce__(self) -> tuple[Any, ...]:
        return PlanarOrbit, (self.reduction, self.u, self.v)

    def __repr__(self) -> str:
        return f"<orbit from u = {self.u}, v = {self.v} to {self.end}>"

    def at(self, t: ArrayLike) -> Any:
        """The states at times t >= 0 after the start: a structured array of their shape with fields t, u, v, q, p (as of
        Reduction.canonical). From end_time on at the centre; NaN where it has gone to infinity or beyond a border."""
        times = numbers("t", t)
        states = np.empty(times.shape, [(name, float) for name in ("t", "u", "v", "q", "p")])
        states["t"] = times
        states["u"], states["v"] = self._core.at(times)
        if self.reduction.form == "scaling":
            states["q"], states["p"] = self.reduction.canonical(states["u"], states["v"])
        else:
            states["q"] = states["p"] = np.nan
        return states[()]


def reduce(
    system: Union[str, Callable[[float, float], tuple[float, float]]], *, u: float, v: float, **parameters: float
) -> Reduction:
    """The symmetries of u' = F(u, v), v' = G(u, v), and the system solved by quadrature, without steps in time.

    system:      a function (u, v) -> (u', v'), or its formulas "u' = F; v' = G", "y' = F(x, y)" or "x'' = F(x, x')", where
                 u, v are x, y and x, x'; an exception, NaN and inf stand for
                 points without a value
    u, v:        a start, not 0: its size is the scale at which the field is sampled
    parameters:  of the formulas
    """
    if not (isinstance(system, str) or callable(system)):
        raise needs("system", "a function (u, v) -> (u', v'), or its formulas \"u' = F; v' = G\",", system)
    known = {name: number(name, value) for name, value in parameters.items()} if isinstance(system, str) else parameters
    return _reduced(system, (number("u", u), number("v", v)), known)


def _reduced(
    system: Union[str, Callable[[float, float], tuple[float, float]]], start: tuple[float, float], parameters: dict[str, float]
) -> Reduction:
    again = _reduced, (system, start, parameters)
    if isinstance(system, str):
        return Reduction(_core.Planar.of_text(system, parameters, *start), system, start, again)
    if parameters:
        raise TypeError(f"reduce: a function has its parameters itself, got {', '.join(parameters)}")
    name = getattr(system, "__name__", "<lambda>")
    return Reduction(
        _core.Planar.of_function(system, *start), "a planar system" if name == "<lambda>" else name, start, again
    )
