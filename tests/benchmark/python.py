"""What a stop time costs in Python, beside SciPy's 2F1 and solve_ivp, in one run: the table of src/python/README.md.

    PYTHONPATH=build/src/python /usr/bin/python3 tests/benchmark/python.py
"""

import math
import time

import contensou as ct
import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import hyp2f1

MU, STARTS = 0.3, 1_000_000
U, V = np.random.default_rng(1).uniform(0.1, 2, (2, STARTS))
OUT = np.empty(STARTS)
PADE, EXACT = (ct.Flow(mu=MU, law=law) for law in ("pade", "exact"))


def by_2f1():
    """The Pade law's closed form, reduction/numerics.md (R41), by SciPy's 2F1."""
    r = 5 / 7 * MU**2
    a, e = r / (2 - r), r / (5 - r)
    grown = 3 * math.pi * (5 - r) * V / (MU * U)
    rest = 8 * (2 - r)
    m = 1 + 1.5 * rest / (rest + grown) * hyp2f1(1, a - e + 1, a + 2, grown / (rest + grown))
    return 16 / (5 * MU) * U + m * 3 * math.pi / 7 * V


def by_solve_ivp(law, u, v):
    """(2.6) in ln u and ln v, until only pivoting is left."""

    def rate(tau, state):
        force, moment = law(math.exp(state[1] - state[0]) / MU)
        return [-5 * MU / (3 * math.pi) * moment / math.exp(state[0]), -7 / (3 * math.pi) * force / math.exp(state[1])]

    stopped = lambda tau, state: state[1] - state[0] - math.log(MU) + 16
    stopped.terminal = True
    run = solve_ivp(rate, (0, 1e6), [math.log(u), math.log(v)], method="LSODA", events=stopped, rtol=1e-10, atol=1e-10)
    return run.t_events[0][0] + 16 / (5 * MU) * math.exp(run.y_events[0][0][0])


def seconds(function, calls):
    start = time.process_time()
    for _ in range(calls):
        function()
    return (time.process_time() - start) / calls


exact, pade = EXACT.stop_time(u=U, v=V), PADE.stop_time(u=U, v=V)
u, v = float(U[0]), float(V[0])
rows = [
    ("u + v, out=", lambda: np.add(U, V, out=OUT), 1, STARTS, 0),
    ("stop_time, exact law, out=", lambda: EXACT.stop_time(u=U, v=V, out=OUT), 1, STARTS, 0),
    ("stop_time, exact law", lambda: EXACT.stop_time(u=U, v=V), 1, STARTS, 0),
    ("stop_time, Pade, out=", lambda: PADE.stop_time(u=U, v=V, out=OUT), 1, STARTS, 0),
    ("Pade in closed form by scipy.special.hyp2f1", by_2f1, 1, STARTS, np.max(np.abs(by_2f1() / pade - 1))),
    ("Flow.stop_time of two numbers", lambda: EXACT.stop_time(u=u, v=v), 10_000, 1, 0),
    ("ct.stop_time of two numbers", lambda: ct.stop_time(u=u, v=v, mu=MU), 10_000, 1, 0),
    ("scipy.integrate.solve_ivp, exact law, LSODA, 1e-10", lambda: by_solve_ivp(EXACT.law, u, v), 3, 1,
     abs(by_solve_ivp(EXACT.law, u, v) / exact[0] - 1)),
]
PUCK = ct.Ball.puck()
rows += [  # of one contact, and of one shot
    ("ct.wrench of one contact, exact law", lambda: ct.wrench("exact", (1, 0, 100), 1.7, (0.2, 3e-3, 1e-4)), 10_000, 1, 0),
    ("ct.wrench of one contact, law uniform", lambda: ct.wrench("uniform", (1, 0, 100), 1.7, (0.2, 3e-3, 1e-4)), 10_000, 1, 0),
    ("ct.step of one contact, exact law", lambda: ct.step("exact", (1, 0, 100), 1.7, (0.2, 3e-3), 20, 2e4, 0.01), 10_000, 1, 0),
    ("Ball.puck().roll, a shot of one ball", lambda: PUCK.roll(slip=0.5, spin=60), 1000, 1, 0),
]
best = [math.inf] * len(rows)
for _ in range(9):  # in turn, the least of nine
    for i, (_, function, calls, starts, _) in enumerate(rows):
        best[i] = min(best[i], seconds(function, calls) / starts)

print("| a start takes | | of our array's | differs by |\n|---|---|---|---|")
for (name, *_, error), cost in zip(rows, best):
    size, unit = (1e3, "ms") if cost > 1e-3 else (1e6, "us") if cost > 1e-7 else (1e9, "ns")
    print(f"| {name} | {cost * size:.3g} {unit} | {cost / best[1]:.3g} | {f'{error:.1g}' if error else ''} |")
