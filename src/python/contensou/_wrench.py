"""Force and moment of contact patches."""

from __future__ import annotations

from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, Literal, Optional, Sequence, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import ArrayFunction
from ._law import Law, LawLike, kept, law as law_of
from ._numbers import flag, needs

if TYPE_CHECKING:
    from ._numbers import Foreign


@lru_cache(maxsize=64)
def _friction(law: LawLike) -> _core.PatchFriction:
    return _core.PatchFriction(law_of(law)._core)


def _columns(given: Sequence[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
    return [each.reshape(-1)[:1] if not any(each.strides) else each.reshape(-1) for each in given]


def _write(law: Law, motions: NDArray[np.float64], *rest: NDArray[np.float64]) -> None:
    kept(_friction, law).wrenches(motions, _columns(rest[:4]), rest[4], rest[5] if len(rest) > 5 else np.empty(0))


def _write_steps(law: Law, motions: NDArray[np.float64], *rest: NDArray[np.float64]) -> None:
    kept(_friction, law).steps(motions, _columns(rest[:6]), rest[6], rest[7])


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
    last axis of an array. One contact takes 1.3 us; a million take 0.06 s.

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
    with_slopes = flag("slopes", slopes)
    if out is None and where is True and (found := kept(_friction, law).wrench(with_slopes, motion, load, *patch)) is not None:
        return found
    wrenches = ArrayFunction("wrench", ("motion", "load", "friction", "radius", "creep"), partial(_write, law_of(law)),
                             ("vx", "vy", "omega"), (1, 2) if with_slopes else (1,))
    return wrenches(motion, load, *patch, out=out, where=where)


@overload
def step(law: LawLike, motion: Foreign, load: Any, patch: tuple[Any, Any], by_force: Any, by_moment: Any, dt: Any, *,
         where: Any = True) -> tuple[Any, Any]: ...
@overload
def step(law: LawLike, motion: ArrayLike, load: ArrayLike, patch: tuple[Any, Any], by_force: ArrayLike, by_moment: ArrayLike,
         dt: ArrayLike, *, out: Optional[tuple[NDArray[Any], NDArray[Any]]] = None,
         where: ArrayLike = True) -> tuple[NDArray[Any], NDArray[Any]]: ...
def step(law: LawLike, motion: Any, load: Any, patch: tuple[Any, Any], by_force: Any, by_moment: Any, dt: Any, *, out: Any = None,
         where: Any = True) -> tuple[Any, Any]:
    """Returns slip and spin of contact patches after an implicit time step under dry friction, and the mean Fx, Fy in N and
    moment in N m of this step, each along the last axis of an array. The friction times dt is the impulse to apply.

    The step never adds energy. A contact rests after it if friction can stop it within dt. The error is of first order in dt.

    law:       a name, a Law or a function, as in `law`; exact, uniform, elliptic and pade are the fastest
    motion:    vx, vy, omega as in `wrench`, changed already by all other forces of the step
    load:      N in newtons; for 0 or less there is no contact, and the motion does not change
    patch:     (f, radius in m), both >= 0
    by_force:  change of slip by a unit of impulse at the contact, 1/kg, >= 0; for a ball 3.5/m, for a disc 1/m
    by_moment: change of spin by a unit of angular impulse, 1/(kg m^2), >= 0; 1/J_z
    dt:        time step in s, >= 0
    out:       pair of arrays for the results
    where:     True for each contact to compute; the others keep the value of out, or are NaN without it

    All arguments broadcast. NaN and numbers out of their range are treated as in `wrench`.
    """
    if not isinstance(patch, (tuple, list)) or len(patch) != 2:
        raise needs("patch", "(friction, radius)", patch)
    rest = (load, *patch, by_force, by_moment, dt)
    one: Optional[tuple[Any, Any]] = kept(_friction, law).step(motion, *rest) if out is None and where is True else None
    if one is not None:
        return one
    names = ("motion", "load", "friction", "radius", "by_force", "by_moment", "dt")
    steps = ArrayFunction("step", names, partial(_write_steps, law_of(law)), ("vx", "vy", "omega"), (1, 1))
    result: tuple[Any, Any] = steps(motion, *rest, out=out, where=where)
    return result
