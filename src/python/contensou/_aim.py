"""The start that fulfils given demands."""

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
    """Finds the one start of a ball, or of a body that lies flat, that fulfils two of these demands when slip and spin
    have ended:

    distance:  path of the centre, m
    turns:     turns about the vertical, of either sign
    time:      duration until then, s

    For a ball it also finds the start with forward slip that begins to roll (slip below 1 mm/s) at a place:

    rolls_at:       distance of the place from the start, m
    rolling_speed:  speed of the final rolling, m/s; 0 if the ball stays there
    spin:           spin about the vertical at the start, rad/s, default 0

    Returns the fields of `contensou aim --format json`. The start is velocity and angular_velocity, arguments of
    Ball.roll, and also its slip (m/s) and spin (rad/s). For demands of distance, turns and time, slip and spin suffice
    for Ball.roll, because the ball then spins only about the vertical. The result is distance, turns and time; for a
    ball also final_velocity, rolls_after, and strike, the cue stroke that gives this start, if any. The start of `ball`
    is not used. Under rolling friction the demands hold when all motion ends.

    Raises ValueError, with the nearest possible values, if no start fulfils both demands; for a slope; and for distance
    with time of a ball with rolling friction, because several starts may fulfil them. Raises TypeError for wrong types.
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
