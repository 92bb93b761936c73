"""Laws of friction, and the names of bodies."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Callable, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import ArrayFunction
from ._numbers import needs, number, numbers, text

if TYPE_CHECKING:
    from ._numbers import Foreign, Number

Body = Union[str, tuple[float, float]]


@dataclass(frozen=True)
class Law:
    """A friction law; `law` makes it. Called with k = v/(mu |u|) of any shape, it returns (force, moment): Phi, the
    force divided by f N, and Psi, the moment divided by f N times the patch radius, each of the shape of k, and NaN
    where k is NaN. `out`, a pair of arrays, and `where` are those of a ufunc.

    name:           a name of `contensou law`, such as exact, pade, uniform, pressure:1.5; formulas in k with their
                    parameters, "phi = k/(a + k); psi = 1/(a + k); a = 2"; or any name for a function or table
    function:       (sliding, pivoting) -> (force, moment), of two speeds >= 0 in one unit, v and mu |u|; the result
                    depends on their ratio alone. Its exceptions pass through unchanged
    rho, pressure:  the pressure of the patch as a table: rho from 0 at the centre to 1 at the edge
    kinks:          each k at which a function is not smooth
    """

    name: str = "exact"
    function: Optional[Callable[[float, float], tuple[float, float]]] = None
    rho: Optional[tuple[float, ...]] = None
    pressure: Optional[tuple[float, ...]] = None
    kinks: tuple[float, ...] = (1.0,)
    _core: _core.Law = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if self.function is not None:
            core = _core.Law(self.function, self.name, list(self.kinks))
        elif self.rho is not None or self.pressure is not None:
            core = _core.Law(self.name, self.rho or (), self.pressure or ())
        else:
            core = _core.Law(text("name", self.name))
        object.__setattr__(self, "_core", core)

    def __reduce__(self) -> tuple[Any, ...]:
        return Law, (self.name, self.function, self.rho, self.pressure, self.kinks)

    def __repr__(self) -> str:
        return f"law({self.name!r})" if self.function is None and self.rho is None else f"<law {self.name}>"

    def _write(self, k: NDArray[np.float64], force: NDArray[np.float64], moment: NDArray[np.float64]) -> None:
        unknown = np.isnan(k)
        known = np.where(unknown, 0, k)
        for result, found in ((force, self._core.force(known)), (moment, self._core.moment(known))):
            result[...] = np.where(unknown, np.nan, found)

    @overload
    def __call__(self, k: Number) -> tuple[float, float]: ...  # type: ignore[misc]
    @overload
    def __call__(self, k: Foreign, *, where: Any = True) -> tuple[Any, Any]: ...
    @overload
    def __call__(self, k: ArrayLike, *, out: Optional[tuple[NDArray[Any], NDArray[Any]]] = None,
                 where: ArrayLike = True) -> tuple[NDArray[Any], NDArray[Any]]: ...
    def __call__(self, k: Any, *, out: Optional[tuple[NDArray[Any], NDArray[Any]]] = None, where: ArrayLike = True) -> tuple[Any, Any]:
        if out is None and where is True and isinstance(k, (float, int)) and k == k:
            return self._core.force(number("k", k))[()], self._core.moment(number("k", k))[()]
        pair: tuple[Any, Any] = ArrayFunction("law", ("k",), self._write, gives=(0, 0))(k, out=out, where=where)
        return pair

    @property
    def pivoting_moment(self) -> float:
        """Psi(0), the moment of pure pivoting."""
        return self._core.pivoting_moment

    @property
    def force_slope(self) -> float:
        """Phi'(0). Slow sliding of a pivoting patch has the force f N Phi'(0) k, like viscous friction."""
        return self._core.force_slope


LawLike = Union[str, Law, Callable[[float, float], tuple[float, float]]]


def law(
    of: LawLike = "exact",
    *,
    name: Optional[str] = None,
    kinks: Sequence[float] = (1.0,),
    rho: Optional[ArrayLike] = None,
    pressure: Optional[ArrayLike] = None,
    **parameters: float,
) -> Law:
    """Returns the law of a name, of a function, of formulas in k with their parameters, or of a tabulated pressure; see
    Law."""
    if parameters and not (isinstance(of, str) and "=" in of):
        raise TypeError(f"law: only formulas have parameters, got {', '.join(parameters)}")
    if rho is not None or pressure is not None:
        table = [tuple(np.ravel(numbers(each, () if column is None else column)).tolist())
                 for each, column in (("rho", rho), ("pressure", pressure))]
        return Law("pressure" if name is None else text("name", name), None, table[0], table[1])
    if isinstance(of, Law):
        return of
    if isinstance(of, str):
        return Law(_core.Law(of, {each: number(each, value) for each, value in parameters.items()}).name if parameters else of)
    if not callable(of):
        raise needs("law", "a name, formulas in k, a Law or a function (sliding, pivoting) -> (force, moment)", of)
    own = getattr(of, "__name__", "<lambda>")
    own = "user's law" if own == "<lambda>" else own
    return Law(own if name is None else text("name", name), of, kinks=tuple(np.atleast_1d(numbers("kinks", kinks)).tolist()))


def body_of(given: Body) -> Body:
    """Returns the canonical name of a body, or its two numbers of inertia."""
    if isinstance(given, str):
        return "disc" if given == "puck" else given
    pair = numbers("body", given)
    if pair.shape != (2,):
        raise needs("body", "a name, as disc, or (chi, gamma)", given)
    return float(pair[0]), float(pair[1])


def core_flow(mu: Optional[float], of: Optional[LawLike], body: Body, drive: float) -> _core.Flow:
    return _core.Flow(None if of is None else law(of)._core, None if mu is None else number("mu", mu), body_of(body),
                      number("drive", drive))


kept_flow = lru_cache(maxsize=64)(core_flow)


def kept(make: Any, *given: Any) -> Any:
    """Returns what a cached function returns; arguments without a hash are not cached."""
    try:
        return make(*given)
    except TypeError as error:
        if "unhashable" not in str(error):
            raise
    return make.__wrapped__(*given)
