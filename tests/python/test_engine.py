"""What to type into physics engines: against the program, and in errors and types of Python."""

import json
import math
import os
import subprocess

import contensou as ct
import pytest

PROGRAM = os.environ.get("CONTENSOU")


def program(*arguments):
    told = json.loads(subprocess.run([PROGRAM, "engine", *arguments, "--format", "json"], capture_output=True, check=True).stdout)
    assert told.pop("schema") == 1
    return told


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
@pytest.mark.parametrize("changes, law, options", [
    ({}, "exact", []),
    ({"slip": 0.3, "spin": -50, "friction": 0.3}, "uniform", ["--slip", "0.3", "--spin", "-50", "--friction", "0.3", "--law", "uniform"]),
])
def test_engines_are_the_programs(changes, law, options):
    ball = ct.Ball.gel(**changes)
    theirs = program("--ball", "gel", *options)
    ours = ct.engines(ball, law=law)
    assert list(ours) == [engine["name"] for engine in theirs["engines"]]
    for engine in theirs["engines"]:
        for setting in engine["settings"]:
            setting["t_spin"], setting["turns"] = float(setting["t_spin"]), float(setting["turns"])
        assert ours[engine["name"]] == {**{name: value for name, value in theirs.items() if name != "engines"}, **engine}
    assert ct.engine("bullet", ball, law=law) == ours["bullet"]


def test_what_never_ends_is_infinite():
    *_, without_moment = ct.engine("mujoco", ct.Ball.pool())["settings"]
    assert without_moment["cone"] == "none" and without_moment["t_spin"] == math.inf


def test_a_law_of_ones_own():
    half = ct.law(lambda sliding, pivoting: (sliding / math.hypot(sliding, pivoting), 0.5 * pivoting / math.hypot(sliding, pivoting)),
                  name="half")
    assert ct.engine("physx", ct.Ball.pool(patch_radius=2e-3), law=half)["parameters"]["minTorsionalPatchRadius"]["value"] == 1e-3


def test_an_engine_under_a_name_of_what_stands_on_it():
    assert ct.engine("isaac", ct.Ball.pool()) == ct.engine("unity", ct.Ball.pool()) == ct.engine("physx", ct.Ball.pool())


def test_an_unknown_engine():
    with pytest.raises(ValueError, match="no such engine 'mujuco' \\(did you mean 'mujoco'\\?\\); engines: mujoco, newton"):
        ct.engine("mujuco", ct.Ball.pool())
