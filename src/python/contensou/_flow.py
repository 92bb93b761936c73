"""Laws, flows, orbits: the phase plane (u, v)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, Callable, Literal, NamedTuple, Optional, Sequence, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import ArrayFunction
from ._display import table
from ._law import Body, Law, LawLike, body_of, core_flow, kept, law as law_of
from ._numbers import number, numbers, thread_count, whole
from ._reduce import Reduction

if TYPE_CHECKING:
    from ._numbers import Foreign, Number, NumberOrNone


class Ray(NamedTuple):
    """An invariant ray v = k mu |u|; the error of k is relative."""

    k: float
    attracts: bool
    accuracy: float


class SingularPoint(NamedTuple):
    """A singular point of the phase plane, at the origin or at infinity, and its eigenvalues."""

    half_line: str
    place: str
    k: float
    q: float
    radial: float
    angular: float
    kind: str


class End(NamedTuple):
    """A limit of k, zero, ray or infinity, for every start with k_from < k < k_to."""

    limit: str
    k_star: float
    k_from: float
    k_to: float


class Terminal(NamedTuple):
    """The limits of k = v/(mu |u|) at the stop: r = gamma mu^2/chi, the values of r at which the regime changes, and
    rays and ends in the order of k."""

    r: float
    r_low: float
    r_high: float
    rays: tuple[Ray, ...]
    ends: tuple[End, ...]

    @property
    def k_star(self) -> float:
        """The limit of k that the largest sector of starts (an angle in the plane of mu |u| and v) reaches."""
        return max(self.ends, key=lambda end: math.atan(end.k_to) - math.atan(end.k_from)).k_star


@dataclass(frozen=True)
class Orbit:
    """The motion from one start to its stop. There are no time steps: any state is the root of one equation."""

    flow: Flow
    u: float
    v: float
    _core: _core.Orbit = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_core", self.flow._core.orbit(number("u", self.u), number("v", self.v)))

    def __reduce__(self) -> tuple[Any, ...]:
        return Orbit, (self.flow, self.u, self.v)

    @property
    def stop_time(self) -> float:
        """The time tau until u = v = 0."""
        return self._core.stop_time

    @property
    def accuracy(self) -> float:
        """The relative error of stop_time."""
        return self._core.accuracy

    @overload
    def at(  # type: ignore[misc]
        self, tau: NumberOrNone = None, *, tau_left: NumberOrNone = None, beta: NumberOrNone = None) -> np.void: ...
    @overload
    def at(self, tau: Optional[ArrayLike] = None, *, tau_left: Optional[ArrayLike] = None,
           beta: Optional[ArrayLike] = None) -> NDArray[np.void]: ...
    def at(self, tau: Optional[ArrayLike] = None, *, tau_left: Optional[ArrayLike] = None,
           beta: Optional[ArrayLike] = None) -> Any:
        """Returns the states at times tau >= 0 after the start, at times tau_left before the stop, or at regularised
        times beta >= 0, as a structured array of their shape with fields tau, u, v, ln_v, k, beta. Near the stop
        v underflows, unlike ln_v."""
        if sum(given is not None for given in (tau, tau_left, beta)) != 1:
            raise TypeError("at: one of tau, tau_left and beta is needed")
        if tau is not None:
            return self._core.at(numbers("tau", tau))[()]
        if tau_left is not None:
            return self._core.at_left(numbers("tau_left", tau_left))[()]
        return self.flow._core.at_beta(number("u", self.u), number("v", self.v), numbers("beta", beta))[()]

    def sample(self, count: int = 201) -> NDArray[np.void]:
        """Returns the states at equidistant times from the start to the stop."""
        if whole("count", count) < 1:
            raise ValueError(f"count: one instant or more is needed, got {count}")
        return self._core.at(np.linspace(0, self.stop_time, count))

    @overload
    def gradient(self, tau: Number) -> dict[str, dict[str, float]]: ...  # type: ignore[misc]
    @overload
    def gradient(self, tau: ArrayLike) -> dict[str, dict[str, NDArray[np.float64]]]: ...
    def gradient(self, tau: ArrayLike) -> dict[str, dict[str, Any]]:
        """Returns u, v, slip_length (the integral of v) and turned (the integral of u) at times tau, with exact partial
        derivatives by the start and by tau, each as {value, u, v, tau}. The time at which v reaches a given value has
        the derivative -g["v"]["u"]/g["v"]["tau"] by the start's u.
        Raises ValueError for a start with u or v of 0."""
        times = numbers("tau", tau)
        found = self.flow._core.instant_gradients(number("u", self.u), number("v", self.v), times)
        return {name: {by: found[i, j].reshape(times.shape)[()] for j, by in enumerate(("value", "u", "v", "tau"))}
                for i, name in enumerate(("u", "v", "slip_length", "turned"))}

    @overload
    def slip_length(self, tau: Number) -> float: ...  # type: ignore[misc]
    @overload
    def slip_length(self, tau: ArrayLike) -> NDArray[np.float64]: ...
    def slip_length(self, tau: ArrayLike) -> Any:
        """Returns the integral of v over [0, tau], in the unit of speed squared."""
        return self._core.slip_length(numbers("tau", tau))[()]


_DERIVATIVES = ("u", "v", "mu", "chi", "gamma", "drive")


@dataclass(frozen=True, init=False)
class Flow:
    """All motions of one system. It is solved once, then returns stop times and states from any start.

    mu:     patch radius divided by R; 0 < mu <= 1 for a ball; disc and ring rest on their whole face, mu = 1
    law:    a name, a Law or a function; by default that of the body, for a ball exact
    body:   ball, hollow-ball, disc, ring, or (chi, gamma): chi = 1 + m R^2/J about a horizontal axis (1 for a body that
            cannot roll), gamma = m R^2/J_z
    drive:  constant force along the slip divided by f N, from 0 to below 1; at 1 the body would not stop. It is rolling
            resistance, u_r/f for a ball that rolls the way it slides, or a slope straight down, tan(angle)/(chi f)
    """

    mu: float
    law: Law
    body: Body
    drive: float
    _core: _core.Flow = field(repr=False, compare=False)

    def __init__(
        self, mu: Optional[float] = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0
    ) -> None:
        of = None if law is None else law_of(law)
        core = core_flow(mu, of, body, drive)
        vars(self).update(mu=core.mu, law=of or Law(core.law.name), body=body_of(body), drive=core.drive, _core=core)

    def __reduce__(self) -> tuple[Any, ...]:
        return Flow, (self.mu, self.law, self.body, self.drive)

    @overload
    def stop_time(  # type: ignore[misc]
        self, *, u: Number, v: Number, threads: int = 1, gradient: Literal[False] = False) -> float: ...
    @overload
    def stop_time(self, *, u: Foreign, v: Any, threads: int = 1, gradient: bool = False, where: Any = True) -> Any: ...
    @overload
    def stop_time(self, *, u: Any, v: Foreign, threads: int = 1, gradient: bool = False, where: Any = True) -> Any: ...
    @overload
    def stop_time(self, *, u: ArrayLike, v: ArrayLike, out: Optional[NDArray[Any]] = None, threads: int = 1,
                  gradient: Literal[False] = False, where: ArrayLike = True) -> NDArray[Any]: ...
    @overload
    def stop_time(  # type: ignore[misc]
        self, *, u: Number, v: Number, gradient: Literal[True]) -> tuple[float, dict[str, float]]: ...
    @overload
    def stop_time(self, *, u: ArrayLike, v: ArrayLike, gradient: Literal[True],
                  where: ArrayLike = True) -> tuple[NDArray[Any], dict[str, NDArray[Any]]]: ...
    def stop_time(self, *, u: Any, v: Any, out: Any = None, threads: int = 1, gradient: bool = False, where: Any = True) -> Any:
        """Returns the time tau until u = v = 0, to a few eps of a double (2e-15 relative).

        u, v:      numbers, or arrays of shapes that broadcast; any u, v >= 0. Invalid or masked entries of an array
                   become NaN
        out:       array of the broadcast shape for the result, float64 or, for float32, float32; may be u or v itself
        threads:   number of threads for a large array; other threads of Python continue meanwhile
        gradient:  True to return tau and a dict of its partial derivatives by u, v, mu, chi, gamma and drive; NaN at
                   rest
        where:     True for each entry to compute; the others keep the value of out, or are NaN without it
        """
        if not gradient and out is None and where is True and isinstance(u, (float, int)) and isinstance(v, (float, int)):
            return self._core.stop_time(number("u", u), number("v", v))
        return _array_stop_times(partial(_write_stop_times_of_flow, self), ("u", "v"), (u, v), out, threads, gradient, where)

    def orbit(self, *, u: float, v: float) -> Orbit:
        """Returns the motion from one start."""
        return Orbit(self, u, v)

    def terminal(self) -> Terminal:
        """Returns the limits of k as the body comes to rest."""
        r, low, high, rays, ends = self._core.terminal()
        return Terminal(r, low, high, tuple(Ray(*ray) for ray in rays), tuple(End(*end) for end in ends))

    def reduction(self) -> FlowReduction:
        """Returns the symmetry of the equations of motion, found numerically, and the plane reduced by it."""
        return FlowReduction(self)

    def facts(self) -> tuple[SingularPoint, ...]:
        """Returns the singular points of the plane, at the origin and at infinity, with their eigenvalues."""
        return tuple(SingularPoint(*point) for point in self._core.facts())


class FlowReduction(Reduction):
    """The reduction of the equations of motion in the coordinates q = v/u and p = ln v. The first integral is ln
    |u| - ln w(k)."""

    def __init__(self, flow: Flow) -> None:
        system = f"(2.6), mu = {flow.mu:g}, law {flow.law.name}"
        super().__init__(_core.Planar.of_flow(flow._core), system, None, (FlowReduction, (flow,)))

    def _canonical(self, u: NDArray[np.float64], v: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        with np.errstate(divide="ignore", invalid="ignore"):
            return v / u, np.log(v)


def _tables_of(law: Optional[LawLike], body: Body, drive: float) -> _core.StopTimesOfMu:
    """Returns the stop times of all mu."""
    return _core.StopTimesOfMu(None if law is None else law_of(law)._core, body_of(body), number("drive", drive))


_kept_flow = lru_cache(maxsize=64)(Flow)
_kept_tables = lru_cache(maxsize=8)(_tables_of)


def _flow(mu: Optional[float], law: Optional[LawLike], body: Body, drive: float) -> Flow:
    flow: Flow = kept(_kept_flow, mu, law, body, drive)
    return flow


@overload
def stop_time(  # type: ignore[misc]
    *, u: Number, v: Number, mu: NumberOrNone = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0,
    threads: int = 1, gradient: Literal[False] = False) -> float: ...
@overload
def stop_time(
    *, u: Foreign, v: Any, mu: Any = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0, threads: int = 1,
    gradient: bool = False, where: Any = True) -> Any: ...
@overload
def stop_time(
    *, u: Any, v: Foreign, mu: Any = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0, threads: int = 1,
    gradient: bool = False, where: Any = True) -> Any: ...
@overload
def stop_time(
    *, u: Any, v: Any, mu: Foreign, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0, threads: int = 1,
    gradient: bool = False, where: Any = True) -> Any: ...
@overload
def stop_time(
    *, u: ArrayLike, v: ArrayLike, mu: Optional[ArrayLike] = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0,
    out: Optional[NDArray[Any]] = None, threads: int = 1, gradient: Literal[False] = False, where: ArrayLike = True) -> NDArray[Any]: ...
@overload
def stop_time(  # type: ignore[misc]
    *, u: Number, v: Number, mu: NumberOrNone = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0,
    gradient: Literal[True]) -> tuple[float, dict[str, float]]: ...
@overload
def stop_time(
    *, u: ArrayLike, v: ArrayLike, mu: Optional[ArrayLike] = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0,
    gradient: Literal[True], where: ArrayLike = True) -> tuple[NDArray[Any], dict[str, NDArray[Any]]]: ...
def stop_time(
    *, u: Any, v: Any, mu: Any = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0, out: Any = None,
    threads: int = 1, gradient: bool = False, where: Any = True) -> Any:
    """Returns the time tau until slip and spin end, u = v = 0, to a few eps of a double (2e-15 relative).

    u:         spin as a speed, R omega with the radius R of the body; any sign
    v:         slip, the sliding speed of the contact point; 0 or more, in the unit of u
    mu:        patch radius divided by R, 0 < mu <= 1; a body "disc" or "ring" has 1. An array of 32 values or more is
               interpolated; the error may then be 8 eps/(1 - drive) larger
    law:       name, Law, or function of two speeds (law); default "exact", for a body "disc" "uniform"
    body:      "ball", "hollow-ball", "disc", "ring", or its numbers of inertia (chi, gamma)
    drive:     constant force along the slip, divided by f times the load, 0 <= drive < 1; f is the coefficient of friction
    out:       array of the broadcast shape for the result, float64 or, for float32, float32; may be u or v itself
    threads:   number of threads for a large array; other threads of Python continue meanwhile
    gradient:  True to return tau and a dict of its partial derivatives by u, v, mu, chi, gamma and drive, each with the
               other arguments fixed; NaN at rest
    where:     True for each entry to compute; the others keep the value of out, or are NaN without it

    u, v, mu and where are numbers, or arrays of shapes that broadcast. The unit of tau is that of u and v: tau is
    (3 pi/2) f g t with the gravity g and the time t, so t = tau/((3 pi/2) f g) is in seconds if u and v are in m/s.
    Invalid or masked entries of an array become NaN; an invalid number raises ValueError. The last flows are cached.

    >>> stop_time(u=1, v=1, mu=0.1)
    33.1683790934...
    """
    if mu is None or isinstance(mu, (float, int)):
        flow: Any = _flow(mu, law, body, drive)
        return flow.stop_time(u=u, v=v, out=out, threads=threads, gradient=gradient, where=where)
    write = partial(_write_stop_times_of_mus, law, body, drive)
    return _array_stop_times(write, ("u", "v", "mu"), (u, v, mu), out, threads, gradient, where)


def _write_stop_times(
    solved: Any, given: Sequence[NDArray[np.float64]], results: Sequence[NDArray[np.float64]], *options: int
) -> None:
    """Writes the stop times by a Flow or StopTimesOfMu of the library; with seven results also the derivatives."""
    if len(results) == 1:
        solved.stop_times(*given, results[0], *options)
        return
    for result, found in zip(results, solved.stop_time_gradients(*given)):
        result[...] = found.reshape(result.shape)


def _write_stop_times_of_flow(flow: Flow, threads: int, u: NDArray[np.float64], v: NDArray[np.float64],
                            *results: NDArray[np.float64]) -> None:
    _write_stop_times(flow._core, (u, v), results, threads)


def _write_stop_times_of_mus(law: Optional[LawLike], body: Body, drive: float, threads: int, u: NDArray[np.float64],
                             v: NDArray[np.float64], mu: NDArray[np.float64], *results: NDArray[np.float64]) -> None:
    if (unknown := np.isnan(mu)).any():
        u, mu = np.where(unknown, np.nan, u), np.where(unknown, 1, mu)
    values, group = np.unique(mu, return_inverse=True)
    group = group.reshape(u.shape)
    if len(values) >= 32:
        for value in (values[0], values[-1]):
            _core.StopTimesOfMu.require(float(value), body_of(body))
        _write_stop_times(kept(_kept_tables, law, body, drive), (u, v, mu), results)
        return
    for i, value in enumerate(values):
        rows = group == i
        parts = [np.empty(np.count_nonzero(rows)) for _ in results]
        _write_stop_times(Flow(float(value), law, body, drive)._core, (u[rows], v[rows]), parts, threads)
        for result, part in zip(results, parts):
            result[rows] = part


def _array_stop_times(write: Callable[..., None], names: Sequence[str], given: Sequence[Any], out: Any, threads: int,
                      gradient: bool, where: ArrayLike) -> Any:
    """Returns the stop times of arrays, which `write` computes by a number of threads."""
    if gradient and (out is not None or threads != 1):
        raise TypeError("stop_time: gradient takes neither out nor threads: leave them out")
    times = ArrayFunction("stop_time", names, partial(write, thread_count(threads)), gives=(0,) * (7 if gradient else 1))
    found = times(*given, out=out, where=where)
    return (found[0], dict(zip(_DERIVATIVES, found[1:]))) if gradient else found


class Check(NamedTuple):
    """One statement of the theory about one motion; the measured error must not exceed the allowed one."""

    law: str
    check: str
    measured: float
    allowed: float
    passed: bool


class Checks(tuple[Check, ...]):
    """The statements that `check` returns."""

    @property
    def passed(self) -> bool:
        return all(row.passed for row in self)

    def raise_for_failure(self) -> Checks:
        """Returns itself if every check passed.
        Raises ArithmeticError, with the names of the failed checks."""
        if self.passed:
            return self
        raise ArithmeticError("\n".join(str(Checks([row])) for row in self if not row.passed))

    def _repr_html_(self) -> str:
        rows = [(row.law, row.check, f"{row.measured:.2g}", f"{row.allowed:.2g}", "yes" if row.passed else "NO") for row in self]
        return table("checks of the theory", ("law", "statement", "measured", "allowed", "passed"), rows)

    def __str__(self) -> str:
        return "\n".join(
            f"{row.law}: {row.check}: {row.measured:.2g}, {row.allowed:.2g} allowed: {'ok' if row.passed else 'FAIL'}"
            for row in self
        )


def check(
    *, u: float, v: float, mu: Optional[float] = None, law: Optional[LawLike] = None, body: Body = "ball", drive: float = 0
) -> Checks:
    """Computes every statement of the theory about the motion from one start as a number that must be small: the routes
    to the stop time against each other, the symmetry, the first integral, the limits. The default is both laws of the
    paper.
    """
    laws: list[Optional[LawLike]] = ["exact", "pade"] if law is None and body in ("ball", "hollow-ball") else [law]
    flows = [_flow(mu, each, body, drive) for each in laws]
    return Checks(Check(flow.law.name, *row) for flow in flows for row in flow._core.check(number("u", u), number("v", v)))
