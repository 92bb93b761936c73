"""The reversed question: which start comes to what is asked for."""

from __future__ import annotations

import json
from typing import Any, Optional

from . import _core
from ._balls import Ball, a_ball
from ._law import LawLike
from ._numbers import number


def aim(
    ball: Ball,
    *,
    distance: Optional[float] = None,
    turns: Optional[float] = None,
    time: Optional[float] = None,
    rolls_at: Optional[float] = None,
    rolling_speed: Optional[float] = None,
    spin: Optional[float] = None,
    law: Optional[LawLike] = None,
) -> dict[str, Any]:
    """The one start of a ball, or of a body that lies flat, that comes to two of these by the time when slip and spin end:

    distance:  m, of the centre; turns: about the vertical, of either sign; time: s

    Or, of a ball, the one with a slip forwards that begins to roll at a place, its slip below 1 mm/s:

    rolls_at:  m from the start; rolling_speed: m/s with which it rolls on in the end, 0 where it stays there
    spin:      rad/s about the vertical at the start, 0 unless given

    The fields of `contensou aim --format json`: velocity and angular_velocity, the start, which roll takes by these names; its
    slip (m/s) and spin (rad/s), which roll(slip=, spin=) takes of a start by distance, turns and time, as that does not roll
    yet; and what it comes to: distance, turns, time; of a ball also final_velocity, rolls_after, and strike, the stroke of a
    cue that starts it, if there is one. The ball's own start does not count.

    Raises ValueError where no start comes to both, with what is nearest, for a slope, and for distance
    with time of a ball with rolling friction, of which several starts may come there. Such a ball is asked where it rests, and
    when all motion ends. TypeError for what is no ball or no number.
    """
    ball = a_ball(ball)

    def asked(name: str, given: Optional[float]) -> Optional[float]:
        return None if given is None else number(name, given)

    distance, turns, time = asked("distance", distance), asked("turns", turns), asked("time", time)
    rolls_at, rolling_speed, spin = asked("rolls_at", rolls_at), asked("rolling_speed", rolling_speed), asked("spin", spin)
    experiment, core = ball._experiment, ball._law(law)._core
    found: dict[str, Any]
    if rolls_at is None and rolling_speed is None and spin is None:
        found = json.loads(_core.aim(experiment, core, distance, turns, time))
        return found
    if rolls_at is None or rolling_speed is None or (distance, turns, time) != (None, None, None):
        raise ValueError("rolls_at and rolling_speed are given together, spin beside them, and no distance, turns and time")
    found = json.loads(_core.aim_to_roll(experiment, core, rolls_at, rolling_speed, spin or 0.0))
    return found
