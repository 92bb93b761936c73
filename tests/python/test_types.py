"""Types: each call returns what mypy says that it returns, and mypy finds a misspelled field of a ball."""

import os
import re
import subprocess
import sys
from pathlib import Path

import contensou as ct
import numpy as np
import pytest

SETUP = """
import contensou as ct
import numpy as np
a = np.array([0.5, 1.0, 1.5])
m = np.array([[1.0, 0.0, 100.0], [2.0, 0.0, 50.0]])
patch = (0.2, 3e-3, 1e-4)
law, flow, pool = ct.law("exact"), ct.Flow(mu=0.3), ct.Ball.pool()
orbit, plane, paper = flow.orbit(u=1, v=1), ct.reduce("u' = -u; v' = -2*v", u=1, v=1), flow.reduction()
film = pool.roll(slip=1, spin=50)(np.linspace(0, 0.5, 40))
"""

#: The kind that each call returns.
CALLS = {
    "float": [
        "ct.stop_time(u=1, v=1, mu=0.3)", "ct.stop_time(u=1, v=1.0, mu=0.3, gradient=True)[0]", "flow.stop_time(u=1, v=1)",
        "flow.stop_time(u=1, v=1, gradient=True)[1]['mu']", "law(1)[0]", "orbit.slip_length(1)", "orbit.gradient(1)['u']['v']",
        "plane.stop_time(u=1, v=1)", "plane.first_integral(1, 2)", "plane.canonical(1, 1)[0]", "paper.canonical(1, 1)[1]",
        "pool.roll(slip=1).rolls_after.t", "pool.roll().path", "pool.mu()", "orbit.stop_time", "ct.stop_time(u=np.float64(1), v=np.int64(1), mu=0.3)"],
    "ndarray": [
        "ct.stop_time(u=a, v=1, mu=0.3)", "ct.stop_time(u=[1, 2], v=1, mu=0.3)", "ct.stop_time(u=1, v=1, mu=a / 2)", "law(a)[1]",
        "ct.stop_time(u=1, v=a, mu=0.3, gradient=True)[1]['u']", "flow.stop_time(u=a, v=1, out=np.empty(3))", "orbit.slip_length(a)",
        "ct.wrench('exact', (1, 0, 100), 1.7, patch)", "ct.wrench('exact', m, 1.7, patch, slopes=True)[1]", "ct.step('exact', m, 1.7, (0.2, 3e-3), 20, 2e4, 0.01)[0]",
        "orbit.gradient(a)['u']['v']",
        "plane.stop_time(u=a, v=1)", "paper.canonical(a, 1)[0]", "orbit.at(tau_left=a)", "pool.roll(slip=1)(a)", "pool.roll(slip=a)(1)",
        "plane.orbit(1, 1).at(a)", "pool.roll(slip=a).path", "pool.roll(slip=a).rest", "pool.roll(slip=a).events", "orbit.sample(3)"],
    "void": ["orbit.at(1)", "orbit.at(beta=0.1)", "pool.roll(slip=1)(0.1)", "plane.orbit(1, 1).at(1)"],
    "Roll": ["pool.roll()", "pool.roll(slip=1, spin=100)", "pool.roll(velocity=(1, 0), angular_velocity=[40, 35, -50])",
             "pool.roll(strike=2, tip=(0.3, -0.2))", "pool.roll(slip=[1, 2])[0]", "pool.roll(slip=1).uncoupled"],
    "Rolls": ["pool.roll(slip=[1, 2])", "pool.roll(slip=a, spin=1, threads=2)", "pool.roll(velocity=[(1, 0), (2, 0)])", "pool.roll(slip=a)[1:]"],
    "Ball": ["ct.Ball.pool(friction=0.3)", "pool.but(slip=2, spin=3)", "ct.Ball.named('steel', mass=1)"],
    "Any": ["pool.roll(strike=2, tip=np.zeros(2))", "pool.roll(velocity=m[:, :2])", "pool.roll(velocity=m[0, :2])"],
    "PlanarOrbit": ["plane.orbit(1, 1)"], "Fit": ["ct.fit(film['t'], slip=film['slip'], spin=film['wz'], ball=pool)"],
}
WRONG = {
    "ct.Ball.pool(fricton=0.3)": 'Unexpected keyword argument "fricton" for "pool" of "Ball"; did you mean "friction"?',
    "ct.Ball.named('pool', slop=1)": 'Unexpected keyword argument "slop" for "named"',
    "ct.Ball.read('mine.toml', mas=1)": 'Unexpected keyword argument "mas" for "read"',
    "pool.but(spn=3)": 'Unexpected keyword argument "spn" for "but"',
    "ct.Ball.steel(mass='heavy')": 'Argument "mass" to "steel" of "Ball" has incompatible type "str"',
    "pool.roll(slp=1)": 'No overload variant of "roll" of "Ball" matches argument type "int"',
    "pool.roll(slip=1).events": '"Roll" has no attribute "events"',
}


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """The messages of mypy about each line."""
    folder = tmp_path_factory.mktemp("types")
    calls = [*(call for group in CALLS.values() for call in group)]
    (folder / "calls.py").write_text(SETUP + "\n".join(f"reveal_type({call})" for call in calls) + "\n" + "\n".join(WRONG))
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "calls.py"], cwd=folder, capture_output=True, text=True,
                         env={**os.environ, "MYPYPATH": str(Path(ct.__file__).parents[1])})
    first = SETUP.count("\n") + 1
    found = {}
    for line in run.stdout.splitlines():
        if match := re.match(r"calls.py:(\d+): (?:note: Revealed type is|error:) (.*)", line):
            found.setdefault([*calls, *WRONG][int(match[1]) - first], []).append(match[2])
    return found


@pytest.mark.parametrize("kind, call", [(kind, call) for kind, group in CALLS.items() for call in group])
def test_a_call_returns_what_its_type_says(kind, call, told):
    revealed, = told[call]
    assert re.sub(r"\[.*", "", revealed.strip('"')).split(".")[-1] == kind
    scope = {}
    exec(SETUP, scope)
    value = eval(call, scope)
    if kind == "Any":
        assert isinstance(value, (ct.Roll, ct.Rolls))
    else:
        assert isinstance(value, {"float": float, "ndarray": np.ndarray, "void": np.void}.get(kind) or getattr(ct, kind))


@pytest.mark.parametrize("call", WRONG)
def test_mypy_finds_what_is_misspelled(call, told):
    message, = told[call]
    assert message.startswith(WRONG[call])
