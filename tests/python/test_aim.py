"""The reversed question: against the motion itself and the program, and in errors and types of Python."""

import json
import os
import subprocess

import contensou as ct
import pytest

PROGRAM = os.environ.get("CONTENSOU")


@pytest.mark.parametrize("ball", [ct.Ball.pool(), ct.Ball.puck(), ct.Ball.pool(law="pade"), ct.Ball.basketball()])
def test_a_start_is_found_again(ball):
    roll = ball.roll(slip=0.8, spin=25)
    end = roll(roll.stop_time)
    for asked in ({"distance": end["x"], "turns": roll.turns}, {"turns": roll.turns, "time": roll.stop_time},
                  {"distance": end["x"], "time": roll.stop_time}):
        found = ct.aim(ball, **asked)
        assert found["slip"] == pytest.approx(0.8, rel=1e-9) and found["spin"] == pytest.approx(25, rel=1e-9)
        assert all(found[name] == pytest.approx(value, rel=1e-12) for name, value in asked.items())


def test_a_ball_begins_to_roll_where_it_is_asked():
    pool = ct.Ball.pool()
    found = ct.aim(pool, rolls_at=0.5, rolling_speed=0.5, spin=30)
    roll = pool.roll(velocity=found["velocity"], angular_velocity=found["angular_velocity"])
    assert roll.rolls_after.x == pytest.approx(0.5, rel=1e-9)
    assert roll(found["time"])["vx"] == pytest.approx(0.5, rel=1e-12)
    with pytest.raises(ValueError, match="rolls_at and rolling_speed are given together"):
        ct.aim(pool, rolls_at=0.5)
    with pytest.raises(ValueError, match="and no distance, turns and time"):
        ct.aim(pool, rolls_at=0.5, rolling_speed=1, turns=1)


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_aim_is_the_programs():
    words = [PROGRAM, "aim", "--ball", "puck", "--distance", "20", "--turns", "3", "--law", "exact", "--format", "json"]
    theirs = json.loads(subprocess.run(words, capture_output=True, check=True).stdout)
    assert theirs.pop("schema") == 1 and theirs.pop("version") == ct.__version__
    assert ct.aim(ct.Ball.puck(), distance=20, turns=3, law="exact") == theirs


def test_what_is_refused():
    with pytest.raises(ValueError, match="no start comes to 20 m in 2 s: that takes 6\\.3866 s or more"):
        ct.aim(ct.Ball.puck(), distance=20, time=2)
    with pytest.raises(ValueError, match="two of distance, turns and time decide a start, got 1"):
        ct.aim(ct.Ball.puck(), distance=20)
    with pytest.raises(ValueError, match="may have two starts"):
        ct.aim(ct.Ball.pool(rolling_friction=0.01), distance=1, time=1)


def test_what_is_no_number_and_no_ball():
    pool = ct.Ball.pool()
    with pytest.raises(TypeError, match="distance: real numbers are needed, got <U1"):
        ct.aim(pool, distance="1", turns=1)
    with pytest.raises(TypeError, match="rolling_speed: one number is needed"):
        ct.aim(pool, rolls_at=1, rolling_speed=[1, 2])
    with pytest.raises(TypeError, match="ball: a Ball is needed, as Ball.pool\\(\\); got 'pool'"):
        ct.aim("pool", distance=1, turns=1)
