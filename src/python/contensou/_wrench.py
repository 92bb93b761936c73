"""Force and moment of contact patches."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._law import LawLike, law as law_of
from ._numbers import flag, needs, numbers


def wrench(law: LawLike, motion: ArrayLike, load: ArrayLike, patch: tuple[ArrayLike, ArrayLike, ArrayLike], *, slopes: bool = False) -> Any:
    """Returns the friction of contact patches on a body: Fx, Fy in N and the moment about the normal in N m, along the
    last axis of an array. One contact or a million contacts may be given; a million take about 0.1 s.

    law:     a name, a Law or a function, as in `law`; exact, uniform, elliptic and pade are the fastest
    motion:  vx, vy of the patch centre relative to the other body, m/s, and omega about the normal, rad/s, on the last axis
    load:    N in newtons; for 0 or less there is no contact, and the result is 0
    patch:   (f, radius in m, creep speed in m/s); f, radius >= 0, creep > 0, below which friction is viscous
    slopes:  True: returns a pair, the second with the derivatives by vx, vy and omega along one more axis

    Motions, loads and the members of the patch broadcast. A NaN or a masked entry gives NaN for its contact; another
    number out of its range raises ValueError with the index of the contact in the flattened arrays.
    """
    motions = numbers("motion", motion)
    if motions.ndim == 0 or motions.shape[-1] != 3:
        raise ValueError(f"motion: vx, vy, omega along the last axis are needed; got an array of shape {motions.shape}")
    if not isinstance(patch, (tuple, list)) or len(patch) != 3:
        raise needs("patch", "(friction, radius, creep)", patch)
    given = [numbers(name, each) for name, each in zip(("load", "friction", "radius", "creep"), (load, *patch))]
    try:
        shape = np.broadcast_shapes(motions.shape[:-1], *(each.shape for each in given))
    except ValueError:
        shapes = ", ".join(str(each.shape) for each in given)
        raise ValueError(f"shapes that broadcast are needed; got motions of {motions.shape[:-1]}; load, friction, radius, creep of {shapes}") from None
    flat = [each.reshape(1) if each.size == 1 else np.broadcast_to(each, shape).reshape(-1) for each in given]
    value = np.empty((*shape, 3))
    slope = np.empty((*shape, 3, 3) if flag("slopes", slopes) else 0)
    _core.wrenches(law_of(law)._core, np.broadcast_to(motions, value.shape), flat, value, slope)
    return (value, slope) if slopes else value
