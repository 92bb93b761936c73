"""Balls and pucks that slide and spin at once, under the friction of Contensou and Zhuravlev.

    import contensou as ct
    ct.stop_time(u=1, v=1, mu=0.1)              # the time tau until slip and spin end
    ct.Flow(mu=0.3).orbit(u=1, v=1).at(tau=2)   # the state at a time
    ct.Ball.pool().roll(slip=1, spin=100)       # a real ball, in SI units
    ct.wrench("exact", (1, 0, 100), 1.7, (0.2, 3e-3, 1e-4))  # force and moment of a contact patch
    ct.fit(t, slip=v, spin=w, ball=ct.Ball.pool())  # friction and patch radius, from a film
    ct.portrait(mu=1).plot()                    # a phase portrait
    ct.reduce("u' = -v - a*u; v' = u - a*v", u=1, v=1, a=0.1)  # the symmetry of any planar system, and its motion

u = R omega_z is the speed of pivoting and v >= 0 the speed of sliding. mu is the radius of the contact patch divided by
R, the radius of the body. tau = (3 pi/2) f g t is the time of V. F. Zhuravlev, 1998, with friction coefficient f and
gravity g. u, v and tau have one unit, which is arbitrary; a Ball is in SI units. Numbers may be arrays of any
shapes that broadcast; masked entries become NaN. Errors of the library are ValueErrors.
"""

from . import _interpreter  # first, because it raises ImportError where the extension module would wait for ever
from ._core import __version__
from ._aim import aim
from ._balls import Ball, Event, Roll, Rolls, balls
from ._engine import engine, engines
from ._fit import Estimate, Fit, fit, fit_plan
from ._flow import Check, Checks, End, Flow, FlowReduction, Orbit, Ray, SingularPoint, Terminal, check, stop_time
from ._law import Law, law
from ._portrait import Portrait, portrait
from ._reduce import Equilibrium, Generator, PlanarOrbit, PlanarRay, Reduction, reduce
from ._wrench import step, wrench

__all__ = [
    "Ball", "Check", "Checks", "End", "Equilibrium", "Estimate", "Event", "Fit", "Flow", "FlowReduction", "Generator", "Law", "Orbit",
    "PlanarOrbit", "PlanarRay", "Portrait", "Ray", "Reduction", "Roll", "Rolls", "SingularPoint", "Terminal", "__version__", "aim",
    "balls", "check", "engine", "engines", "fit", "fit_plan", "law", "portrait", "reduce", "step", "stop_time", "wrench",
]
