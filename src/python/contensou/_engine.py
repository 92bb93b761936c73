"""Numbers to type into physics engines."""

from __future__ import annotations

import json
from typing import Any, Optional

from . import _core
from ._balls import Ball, a_ball
from ._law import LawLike
from ._numbers import text


def _with_infinity(members: dict[str, Any]) -> dict[str, Any]:
    return {key: float(value) if value == "inf" else value for key, value in members.items()}


def _told(name: Optional[str], ball: Ball, law: Optional[LawLike]) -> list[dict[str, Any]]:
    ball = a_ball(ball)
    told = json.loads(_core.engines(ball._experiment, ball._law(law)._core, name), object_hook=_with_infinity)
    return [{**told, **each} for each in told.pop("engines")]


def engine(name: str, ball: Ball, *, law: Optional[LawLike] = None) -> dict[str, Any]:
    """Returns the numbers to type into a physics engine for a ball's torsional friction, and the resulting slip and
    spin from its start: the fields of `contensou engine NAME --format json`, those of the ball and of the engine in one
    dict. isaac, unity and unreal are names of the engines that they use.

    parameters:      {name: {value, unit, formula}}, numbers to type in; the last determines the moment
    needs:           switches that must be on for the numbers to act
    combination:     combination of the numbers of two bodies
    settings:        [{setting, cone, moment_arm, t_slip, t_spin, slip_length, turns}], nearest to the law first, then
                     other common settings
    t_slip, t_spin:  time in s until 1e-3 of slip and of spin is left, under the law
    slip_length, turns:  length in m of slip, and turns about the vertical, until the stop, under the law
    """
    return _told(text("name", name), ball, law)[0]


def engines(ball: Ball, *, law: Optional[LawLike] = None) -> dict[str, dict[str, Any]]:
    """Returns `engine` for each known engine, by name."""
    return {each["name"]: each for each in _told(None, ball, law)}
