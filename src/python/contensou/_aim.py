"""The reversed question: which start comes to what is asked for."""

from __future__ import annotations

import json
from typing import Any, Optional

from . import _core
from ._balls import Ball
from ._flow import LawLike


def aim(
    ball: Ball,
    *,
    distance: Optional[float] = None,
    turns: Optional[float] = None,
    time: Optional[float] = None,
    law: Optional[LawLike] = None,
) -> dict[str, Any]:
    """The one start of a ball, or of a body that lies flat, that comes to two of these by the time when slip and spin end:

    distance:  m, of the centre; turns: about the vertical, of either sign; time: s

    The fields of `contensou aim --format json`: slip (m/s) and spin (rad/s) of the start, which roll(slip=, spin=) takes,
    and what it comes to: distance, turns, time; of a ball also final_velocity, rolls_after, and strike, the stroke of a cue
    that starts it, if there is one. The ball's own start does not count.

    Raises ValueError where no start comes to both, with what is nearest, for a slope, and for distance
    with time of a ball with rolling friction, of which several starts may come there. Such a ball is asked where it rests, and
    when all motion ends.
    """
    found: dict[str, Any] = json.loads(_core.aim(ball._experiment, ball._law(law)._core, distance, turns, time))
    return found
