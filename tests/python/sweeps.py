"""The recipes of the README for many cores, run as they stand there, with 10^5 starts in place of 10^8, and three films."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import contensou as ct
import numpy as np

README = Path(__file__).parents[2] / "src/python/README.md"
SMALLER = {"size=10**6": "size=10**4", "range(100)": "range(10)", "rank, 100, world": "rank, 10, world", "10**8": "10**5", "(1, 10**6)": "(1, 10**4)"}


def recipe(name):
    """The block of the README for a file, and its number of lines."""
    code, = re.findall(rf"```python\n# {name}\n(.*?)```", README.read_text(), re.S)
    return code, sum(bool(line.strip()) for line in code.splitlines())


def run(name, folder, *launcher):
    """Returns the longest stop time and the fits that a recipe prints."""
    for file in ("tasks.py", name):
        code, lines = recipe(file)
        assert lines <= 10
        for full, few in SMALLER.items():
            code = code.replace(full, few)
        (folder / file).write_text(code)
    assert (folder / name).read_text() != recipe(name)[0] or (folder / "tasks.py").read_text() != recipe("tasks.py")[0]
    (folder / "films").mkdir()
    generator, t = np.random.default_rng(2), np.arange(0, 0.4, 1 / 120)
    for i, friction in enumerate((0.15, 0.2, 0.25)):
        film = ct.Ball.pool(friction=friction).roll(slip=1, spin=60)(t)
        columns = t, film["slip"] + generator.normal(0, 0.01, t.size), film["wz"] + generator.normal(0, 1, t.size)
        np.savetxt(folder / f"films/{i}.csv", np.transpose(columns), delimiter=",", header="t,slip,spin", comments="")
    done = subprocess.run([*launcher, sys.executable, name], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    longest, fits = done.stdout.strip().splitlines()[-2:]
    return float(longest), ast.literal_eval(fits)


def longest_of_parts():
    parts = [np.random.default_rng(part).uniform(0.1, 2, (2, 10**4)) for part in range(10)]
    return max(ct.stop_time(u=u, v=v, mu=0.3).max() for u, v in parts)


def are_fits(fits):
    """Returns True if they are those of the films, in their order."""
    return len(fits) == 3 and all(abs(value - friction) < 4 * error < 0.05 for friction, (value, error) in zip((0.15, 0.2, 0.25), fits))
