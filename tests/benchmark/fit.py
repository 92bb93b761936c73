"""What a fit costs beside SciPy's least_squares on solve_ivp, in one run: the table of src/fit/README.md.

    PYTHONPATH=build/src/python:tests/python /usr/bin/python3 tests/benchmark/fit.py
"""

import math
import time

import contensou as ct
import numpy as np
from test_fit import BALL, SD, T, by_scipy, film

SEEN = film()
UNKNOWN = BALL.but(friction=0.5, patch_radius=1e-3)
LONG = np.linspace(0, 0.5, 100_000)
RANDOM = np.random.default_rng(2)
AT = BALL.roll(slip=1, spin=100)(LONG)
LONG_SEEN = {"slip": AT["slip"] + RANDOM.normal(0, SD["slip"], LONG.size), "spin": AT["wz"] + RANDOM.normal(0, SD["spin"], LONG.size)}


def seconds(function, calls):
    start = time.process_time()
    for _ in range(calls):
        function()
    return (time.process_time() - start) / calls


rows = [
    ("ct.fit, 60 instants, errors known", lambda: ct.fit(T, ball=UNKNOWN, sd=SD, **SEEN), 20),
    ("ct.fit, errors estimated", lambda: ct.fit(T, ball=UNKNOWN, **SEEN), 20),
    ("ct.fit, 100 000 instants, errors known", lambda: ct.fit(LONG, ball=UNKNOWN, sd=SD, **LONG_SEEN), 1),
    ("least_squares on solve_ivp, LSODA, 1e-10, from a start nearby, 60 instants", lambda: by_scipy(SEEN), 1),
]
best = [math.inf] * len(rows)
for _ in range(9):  # in turn, the least of nine
    for i, (_, function, calls) in enumerate(rows):
        best[i] = min(best[i], seconds(function, calls))

print("| a fit takes | | of the first |\n|---|---|---|")
for (name, *_), cost in zip(rows, best):
    print(f"| {name} | {cost * 1e3:.3g} ms | {cost / best[0]:.3g} |")
