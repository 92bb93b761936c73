"""Force and moment of contact patches."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Literal, Optional, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import ArrayFunction
from ._law import Law, LawLike, law as law_of
from ._numbers import flag, needs

if TYPE_CHECKING:
    from ._numbers import Foreign


def _write(law: Law, motions: NDArray[np.float64], *rest: NDArray[np.float64]) -> None:
    given = [each.reshape(-1)[:1] if not any(each.strides) else each.reshape(-1) for each in rest[:4]]
    _core.wrenches(law._core, motions, given, rest[4], rest[5] if len(rest) > 5 else np.empty(0))


@overload
def wrench(law: LawLike, motion: Foreign, load: Any, patch: tuple[Any, Any, Any], *, slopes: bool = False, where: Any = True) -> Any: ...
@overload
def wrench(law: LawLike, motion: Any, load: Foreign, patch: tuple[Any, Any, Any], *, slopes: bool = False, where: Any = True) -> Any: ...
@overload
def wrench(law: LawLike, motion: ArrayLike, load: ArrayLike, patch: tuple[Any, Any, Any], *, slopes: Literal[False] = False,
           out: Optional[NDArray[Any]] = None, where: ArrayLike = True) -> NDArray[Any]: ...
@overload
def wrench(law: LawLike, motion: ArrayLike, load: ArrayLike, patch: tuple[Any, Any, Any], *, slopes: Literal[True],
           out: Optional[tuple[NDArray[Any], NDArray[Any]]] = None, where: ArrayLike = True) -> tuple[NDArray[Any], NDArray[Any]]: ...
def wrench(law: LawLike, motion: Any, load: Any, patch: tuple[Any, Any, Any], *, slopes: bool = False, out: Any = None,
           where: Any = True) -> Any:
    """Returns the friction of contact patches on a body: Fx, Fy in N and the moment about the normal in N m, along the
    last axis of an array. One contact or a million contacts may be given; a million take about 0.1 s.

    law:     a name, a Law or a function, as in `law`; exact, uniform, elliptic and pade are the fastest
    motion:  vx, vy of the patch centre relative to the other body, m/s, and omega about the normal, rad/s, on the last axis
    load:    N in newtons; for 0 or less there is no contact, and the result is 0
    patch:   (f, radius in m, creep speed in m/s); f, radius >= 0, creep > 0, below which friction is viscous
    slopes:  True: returns a pair, the second with the derivatives by vx, vy and omega along one more axis
    out:     array for the result; with slopes a pair of them
    where:   True for each contact to compute; the others keep the value of out, or are NaN without it

    Motions, loads and the members of the patch broadcast. A NaN or a masked entry gives NaN for its contact; another
    number out of its range raises ValueError with the index of the contact in the flattened arrays, among those computed.
    """
    if not isinstance(patch, (tuple, list)) or len(patch) != 3:
        raise needs("patch", "(friction, radius, creep)", patch)
    wrenches = ArrayFunction("wrench", ("motion", "load", "friction", "radius", "creep"), partial(_write, law_of(law)),
                             ("vx", "vy", "omega"), (1, 2) if flag("slopes", slopes) else (1,))
    return wrenches(motion, load, *patch, out=out, where=where)
