"""The symmetries of a planar system, and the motions that they solve."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Callable, Iterable, NamedTuple, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._display import table, with_picture
from ._numbers import needs, number, numbers, together
from ._portrait import Portrait, points_of

if TYPE_CHECKING:
    from ._numbers import Number


class Generator(NamedTuple):
    """X = c t d/dt + (A x + b) . d/dx, x = (u, v), with the largest entry 1. If `everywhere` is False, X maps the
    field onto itself within each sector in which the field is smooth, and not across their borders."""

    time: float
    matrix: NDArray[np.float64]
    shift: NDArray[np.float64]
    everywhere: bool = True


class PlanarRay(NamedTuple):
    """A direction in which orbits stay; radial and angular are the eigenvalues along it and across it."""

    angle: float
    attracts: bool
    to_centre: bool
    radial: float
    angular: float


class Equilibrium(NamedTuple):
    """An isolated zero of the field.

    kind is "degenerate" or "center or focus" if nothing proves more, and "not smooth" at a kink or jump of the field.
    eigenvalues is None if the field is not smooth there. index is the number of turns of the field on a small circle;
    None if it is not known.
    """

    u: float
    v: float
    kind: str
    eigenvalues: Optional[tuple[complex, complex]]
    index: Optional[int]  # type: ignore[assignment]  # hides the method of tuples


class Reduction:
    """The result of `reduce`.

    generators:       generators c t d/dt + (A x + b) . d/dx; the one that solves the system is first; () for none
    singular_values:  of the determining equations, increasing, relative to the largest; below level they count as 0
    gap:              distance of the values that count as 0 from the others
    verdict:          found, none, or undecided: the field's noise hides the effect of a generator
    solved:           True if a scaling or an inverse integrating factor solves it; else the methods raise ValueError
    form:             the solution: "scaling", or the form of the factor, such as "polynomial"; else None
    tried:            forms of the factor that were tried: (form, least singular value, gap, residual, cleared); cleared:
                      V was multiplied by the denominator of the field

    For typed equations, print shows the steps as `contensou reduce` does. equation, variables, steps and
    integral_formula are parts of this answer.

    orbit and portrait show the motions of the system. Points are numbers, or arrays of shapes that broadcast; results
    without a value are NaN.
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
        self.tried: tuple[tuple[str, float, float, float, bool], ...] = tuple(core.tried)
        self._typed = isinstance(again[1][0], str)
        self._answer: Optional[tuple[str, dict[str, Any]]] = None

    def _answered(self) -> tuple[str, dict[str, Any]]:
        """Returns the answer of `contensou reduce` as text and as the members of its JSON."""
        if not self._typed:
            raise ValueError("reduce: only typed equations are explained as formulas, not a function")
        if self._answer is None:
            text, members = self._core.answer()
            self._answer = text, json.loads(members)
        return self._answer

    @property
    def equation(self) -> tuple[str, ...]:
        """The kinds of the equation in the words of textbooks, such as ("homogeneous", "separable after q = y/x")."""
        return tuple(self._answered()[1]["equation"])

    @property
    def variables(self) -> tuple[str, str]:
        """The typed letters of u and v, such as ("x", "x'")."""
        first, second = self._answered()[1]["variables"]
        return first, second

    @property
    def steps(self) -> dict[str, Optional[str]]:
        """The coordinates q and p and the separated equation as formulas; None for a part that was not found."""
        return dict(self._answered()[1]["steps"])

    @property
    def integral_formula(self) -> Optional[str]:
        """The constant of the motion H as a formula; None if none was found."""
        formula: Optional[str] = self._answered()[1]["integral_formula"]
        return formula

    def __str__(self) -> str:
        return self._answered()[0] if self._typed else repr(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return self._again

    def __repr__(self) -> str:
        if self.solved:
            return f"<reduction: {self.kind if self.form == 'scaling' else self.form}>"
        return f"<reduction: {len(self.generators)} generators, no factor>"

    def _repr_svg_(self) -> Optional[str]:
        try:
            return self.portrait().svg()
        except (ValueError, OSError, RuntimeError):  # no picture of this system, or no gnuplot
            return None

    def _repr_html_(self) -> str:
        if self._typed:
            lines = [(line[:13].strip(), line[13:]) for line in str(self).splitlines()]
            return with_picture(table(self._system, ("", ""), lines), self._repr_svg_())
        rows: list[tuple[str, Any]] = [("solved by", self.form or "no quadrature"), ("verdict on symmetries", self.verdict)]
        if self.form == "scaling":
            rows.append(("kind of the centre", self.kind))
        for time, matrix, shift, everywhere in self.generators:
            numbers = [time, *matrix[0], shift[0], *matrix[1], shift[1]]
            terms = ("t d/dt", "u d/du", "v d/du", "d/du", "u d/dv", "v d/dv", "d/dv")
            parts = [f"{each:.6g} {term}" for each, term in zip(numbers, terms) if abs(each) > 1e-9]
            rows.append(("symmetry" if everywhere else "symmetry of a sector", " + ".join(parts).replace("+ -", "- ")))
        for each in self.equilibria:
            rows.append((each.kind, f"({each.u:g}, {each.v:g})"))
        return with_picture(table(self._system, ("", ""), rows), self._repr_svg_())

    @property
    def generator(self) -> Generator:
        """The first generator. Raises ValueError if there is none."""
        if self.generators:
            return self.generators[0]
        raise ValueError(f"no generator of this form, or none that is known: the verdict is {self.verdict}")

    @property
    def kind(self) -> str:
        """The kind of the blown-up centre: stable node, saddle, stable focus, ..."""
        return self._core.kind

    @overload
    def factor(self, u: Number, v: Number) -> float: ...  # type: ignore[misc]
    @overload
    def factor(self, u: ArrayLike, v: ArrayLike) -> NDArray[np.float64]: ...
    def factor(self, u: ArrayLike, v: ArrayLike) -> Any:
        """Returns an inverse integrating factor V, for which f . grad V = V div f; NaN where it is not known."""
        return self._core.factor(*together(u=u, v=v))[()]

    @property
    def equilibria(self) -> tuple[Equilibrium, ...]:
        """The isolated equilibria in the rectangle equilibria_within."""
        return tuple(Equilibrium(*each) for each in self._core.equilibria)

    @property
    def equilibria_within(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Ranges of u and of v in which equilibria are sought and reversors compared: |u|, |v| up to 2.5 times the larger of
        |u|, |v| of the start given to reduce."""
        return self._core.equilibria_within

    @property
    def equilibria_complete(self) -> bool:
        """False if there may be more equilibria in this rectangle."""
        return self._core.equilibria_complete

    @property
    def reversors(self) -> tuple[str, ...]:
        """Images of (u, v) under the linear maps R that reverse motions, f(R x) = -R f(x), such as "(u, -v)". The maps are
        compared at points of the rectangle equilibria_within."""
        return tuple(self._core.reversors)

    @property
    def rays(self) -> tuple[PlanarRay, ...]:
        return tuple(PlanarRay(*ray) for ray in self._core.rays)

    @property
    def turn(self) -> Optional[tuple[float, float]]:
        """For a focus, the factor of exp(p) and the growth of sigma in one turn, d sigma = exp(-c p) dt; else None."""
        return self._core.turn

    @overload
    def canonical(self, u: Number, v: Number) -> tuple[float, float]: ...  # type: ignore[misc]
    @overload
    def canonical(self, u: ArrayLike, v: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def canonical(self, u: ArrayLike, v: ArrayLike) -> tuple[Any, Any]:
        """Returns q, the angle, and p, the only coordinate that the symmetry changes. p is ln(d/d0) with the distance d
        from the centre, and d0 the distance of the start given to reduce."""
        q, p = self._canonical(*together(u=u, v=v))
        return q[()], p[()]

    def _canonical(self, u: NDArray[np.float64], v: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        return self._core.canonical(u, v)

    @overload
    def first_integral(self, u: Number, v: Number) -> float: ...  # type: ignore[misc]
    @overload
    def first_integral(self, u: ArrayLike, v: ArrayLike) -> NDArray[np.float64]: ...
    def first_integral(self, u: ArrayLike, v: ArrayLike) -> Any:
        """Returns a number that is constant along an orbit; NaN on rays."""
        return self._core.first_integral(*together(u=u, v=v))[()]

    @overload
    def stop_time(self, *, u: Number, v: Number) -> float: ...  # type: ignore[misc]
    @overload
    def stop_time(self, *, u: ArrayLike, v: ArrayLike) -> NDArray[np.float64]: ...
    def stop_time(self, *, u: ArrayLike, v: ArrayLike) -> Any:
        """Returns the time to the centre, relative 1e-12; inf if not reached; NaN beyond a border of the field or a
        jump."""
        return self._core.stop_time(*together(u=u, v=v))[()]

    def orbit(self, u: float, v: float) -> PlanarOrbit:
        """Returns the motion from one start.

        Without a solution the motion is followed by steps in time, each with a relative error of 1e-12.
        """
        return PlanarOrbit(self, number("u", u), number("v", v))

    def portrait(
        self,
        *,
        u: Optional[float] = None,
        v: Optional[float] = None,
        view: Optional[str] = None,
        window: Union[None, tuple[float, float], tuple[tuple[float, float], tuple[float, float]]] = None,
        orbits: Optional[int] = None,
        through: Iterable[tuple[float, float]] = (),
        isochrones: Union[None, int, Sequence[float]] = None,
        arrows: str = "time",
        field: str = "none",
        axes: bool = True,
        nullclines: bool = False,
        colour: str = "time",
        style: str = "print",
        size: Union[None, str, tuple[float, float]] = None,
        title: Optional[str] = None,
        font: str = "",
        dpi: float = 300,
    ) -> Portrait:
        """Returns the plane with orbits, rays and isochrones, as `contensou portrait --system` draws it.

        Orbits of a field that is not solved are followed by steps in time.

        u, v:        start of an orbit to highlight; by default the start given to reduce
        view:        disc for the whole plane with infinity as a circle, if the system is typed polynomials
        window:      (U, V), about the centre, or ((U1, U2), (V1, V2)); by default equilibria, limit cycles and the points
        orbits:      number of orbits; by default enough to fill the window
        through:     points (u, v) whose orbits are shown, too
        isochrones:  approximate number of lines of equal time left, or their times
        field:       none or motion
        axes:        True to draw the rays, separatrices and limit cycles
        nullclines:  True to draw the curves on which u, or v, does not change
        arrows, colour, style, size, title, font, dpi:  as in contensou.portrait
        """
        asked: dict[str, Any] = dict(locals(), through=points_of(through))
        asked["reduction"] = asked.pop("self")
        if u is None and v is None and self._start is not None:
            asked["u"], asked["v"] = self._start
        return Portrait(_of_plane, asked)


def _of_plane(asked: dict[str, Any]) -> _core.Portrait:
    reduction = asked["reduction"]
    return _core.Portrait(reduction._core, reduction._system, asked)


class PlanarOrbit:
    """One motion; Reduction.orbit makes it.

    end:        centre, infinity, rest (another point with a field of 0), border (a jump or end of values), periodic,
                equilibrium or cycle (approached for ever); None if it is not decided
    end_time:   time of the end, relative 1e-12; inf if it takes for ever, or is not known
    stop_time:  time at the centre; inf if it is never reached; NaN if the motion ends at a border
    period:     period of a motion that returns; else None
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

    @overload
    def at(self, t: Number) -> np.void: ...  # type: ignore[misc]
    @overload
    def at(self, t: ArrayLike) -> NDArray[np.void]: ...
    def at(self, t: ArrayLike) -> Any:
        """Returns the states at times t >= 0 after the start, as a structured array of their shape with fields t, u, v,
        q, p (as in Reduction.canonical). From end_time on: the centre; NaN at infinity and beyond a border."""
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
    """Finds the symmetries of u' = F(u, v), v' = G(u, v), and solves the system by quadrature, without steps in time.

    system:      a function (u, v) -> (u', v'), or equations in any letters as `contensou help formulas` shows them, such
                 as "x' = y; y' = -x"; an exception, NaN or inf marks a point without a value
    u, v:        a start; u is the first letter of the equations. Its size is the scale at which the field is sampled
    parameters:  parameters of the formulas
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
