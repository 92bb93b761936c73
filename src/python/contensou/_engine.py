"""What to type into physics engines."""

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
    """What to type into a physics engine for a ball's torsional friction, and what slip and spin of its start then do: the
    fields of `contensou engine NAME --format json`, those of the ball and those of the engine in one dict. isaac, unity and
    unreal are the engine that they stand on.

    parameters:      {name: {value, unit, formula}}, what to type in; that of the moment is the last
    needs:           switches without which they do nothing; combination: of the two bodies' numbers
    settings:        [{setting, cone, moment_arm, t_slip, t_spin, slip_length, turns}], the one nearest to the law first,
                     then what else is met
    t_slip, t_spin:  s until 1e-3 of slip and spin is left, under the law
    slip_length, turns:  m that the contact slides and turns about the vertical until then, under the law
    """
    return _told(text("name", name), ball, law)[0]


def engines(ball: Ball, *, law: Optional[LawLike] = None) -> dict[str, dict[str, Any]]:
    """`engine` of each engine that is known, by name."""
    return {each["name"]: each for each in _told(None, ball, law)}
