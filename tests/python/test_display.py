"""The display in a notebook: tables, and pictures below them."""

import sys
import xml.etree.ElementTree as ElementTree

import contensou as ct
import numpy as np
import pytest
from matplotlib import pyplot

POOL = ct.Ball.pool(name="<my> ball")
ROLL = POOL.roll(slip=1, spin=100, rolling_friction=0.01)
T = np.linspace(0, 0.5, 40)
FILM, NOISE = POOL.roll(slip=1, spin=100)(T), np.random.default_rng(1).normal(size=(2, T.size))
FIT = ct.fit(T, slip=FILM["slip"] + 0.01 * NOISE[0], spin=FILM["wz"] + NOISE[1], ball=POOL)
NODE = ct.reduce("u' = -u; v' = -2*v", u=1, v=1)
CHECKS = ct.check(mu=0.3, u=1, v=1)


def table(shown):
    """The rows of the table."""
    html, = [part + "</table>" for part in shown._repr_html_().split("</table>")[:-1]]
    return [[cell.text or "" for cell in row] for row in ElementTree.fromstring(html).iter("tr")]


@pytest.mark.parametrize("shown, cells", [
    (ROLL, [["", "this motion", "textbook"], ["rolls after, s", f"{ROLL.rolls_after.t:.6g}", f"{ROLL.uncoupled.rolls_after.t:.6g}"],
            ["turns", f"{ROLL.turns:.6g}", f"{ROLL.uncoupled.turns:.6g}"],
            ["centre rests after, s", f"{ROLL.rest.t:.6g}", f"{ROLL.uncoupled.rest.t:.6g}"]]),
    (ct.Ball.puck().roll(slip=1, spin=0).uncoupled, [["", "textbook"], ["turns", "0"]]),
    (FIT, [["patch_radius", *(f"{value:.6g}" for value in FIT.patch_radius), "m"]]),
    (ct.fit_plan(T, ball=POOL.but(slip=1, spin=100), sd={"slip": 0.01}), [["", "value", "standard error", "95 % from", "to", "unit"]]),
    (NODE, [["coordinates", "q = v/u,  p = ln(abs(u))"]]),
    (ct.reduce("x'' = -sin(x)", u=1, v=0), [["separated", "dp/dq = -sin(q)"]]),
    (CHECKS, [["law", "statement", "measured", "allowed", "passed"],
              ["exact", CHECKS[0].check, f"{CHECKS[0].measured:.2g}", f"{CHECKS[0].allowed:.2g}", "yes"]])],
    ids=["roll", "textbook", "fit", "plan", "node", "pendulum", "checks"])
def test_tables(shown, cells):
    found = table(shown)
    assert all(row in found for row in cells), found


@pytest.mark.parametrize("shown", [ROLL, FIT, NODE], ids=["roll", "fit", "reduction"])
def test_pictures_are_below_the_tables(shown):
    before = pyplot.get_fignums()
    svg = shown._repr_svg_()
    assert ElementTree.fromstring(svg).tag.endswith("svg")
    assert shown._repr_html_().count("<svg") == 1 and "</table>\n<div><svg" in shown._repr_html_()
    assert pyplot.get_fignums() == before


def test_words_are_escaped_and_misfits_are_told():
    assert "&lt;my&gt; ball" in ROLL._repr_html_() and "<my>" not in ROLL._repr_html_().split("</table>")[0]
    wrong = ct.fit(T, slip=np.cos(20 * T) ** 2, spin=50 - T, ball=POOL)
    assert wrong.misfits and wrong._repr_html_().count("<p>") == len(wrong.misfits)
    assert ["exact", "a", "2", "1", "NO"] in table(ct.Checks([ct.Check("exact", "a", 2, 1, False)]))


def test_tables_without_what_draws(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.setenv("PATH", "")
    for shown in (ROLL, FIT, NODE):
        assert shown._repr_svg_() is None and shown._repr_html_().endswith("</table>")
    assert ct.fit_plan(T, ball=POOL.but(slip=1, spin=100), sd={"slip": 0.01})._repr_svg_() is None
