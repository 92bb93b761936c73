"""Portraits as data, as the program draws them, and by matplotlib."""

import copy
import os
import pickle
import subprocess
import sys

import contensou as ct
import numpy as np
import pytest

PROGRAM = os.environ.get("CONTENSOU")


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
@pytest.mark.parametrize("given, options", [
    ({"mu": 0.3}, ["--mu", "0.3"]),
    ({"ball": ct.Ball.pool(slip=2), "size": "single"}, ["--ball", "pool", "--slip", "2", "--size", "single"]),
    ({"body": "disc", "view": "similarity", "u": 1, "v": 1, "orbits": 4, "arrows": "one", "colour": "none", "axes": False},
     ["--body", "disc", "--view", "similarity", "--u0", "1", "--v0", "1", "--orbits", "4", "--arrows", "one", "--colour",
      "none", "--axes", "off"]),
    ({"mu": 1, "view": "time", "estimate": True}, ["--mu", "1", "--view", "time", "--estimate"]),
    ({"mu": 0.2, "law": "pade", "against": "exact", "window": (2, 1), "isochrones": 3, "through": [(1, 0.5)], "field": "motion",
      "style": "screen", "scale": "linear", "size": (150, 100), "title": "mine"},
     ["--mu", "0.2", "--law", "pade", "--against", "exact", "--window", "2,1", "--isochrones", "3", "--through", "1,0.5",
      "--field", "motion", "--style", "screen", "--scale", "linear", "--size", "150x100", "--title", "mine"]),
])
def test_a_portrait_is_the_programs(given, options):
    theirs = subprocess.run([PROGRAM, "portrait", *options, "-o", "-", "--format", "gp"], capture_output=True, check=True).stdout
    assert ct.portrait(**given).render("gp") == theirs


def test_as_a_file(tmp_path):
    portrait = ct.portrait(mu=1, orbits=3)
    assert portrait.svg().startswith("<?xml") and portrait._repr_svg_() == portrait.svg()
    portrait.save(tmp_path / "mine.tex")
    assert (tmp_path / "mine.tex").read_bytes() == portrait.render("tex")
    with pytest.raises(ValueError, match="no such format 'bmp'; formats: svg, "):
        portrait.save(tmp_path / "mine.bmp")
    for other in (pickle.loads(pickle.dumps(portrait)), copy.deepcopy(portrait)):
        assert other.render("gp") == portrait.render("gp") and repr(other) == repr(portrait)


def test_as_data():
    data = ct.portrait(mu=0.3, u=1, v=1, against="pade").data
    orbit = data["orbits"][0]
    assert orbit["u"].dtype == float and orbit["u"][-1] == 0 and orbit["ln_v"][-1] == -np.inf
    assert data["highlight"]["tau_left"][0] == pytest.approx(ct.stop_time(u=1, v=1, mu=0.3), rel=1e-14)
    assert data["against"]["law"] == "pade"
    for line in data["isochrones"]:
        taus = ct.stop_time(u=line["u"], v=line["v"], mu=0.3)
        np.testing.assert_allclose(taus, line["tau_stop"], rtol=1e-9)


@pytest.mark.parametrize("view, panels", [("uv", 1), ("blowup", 2), ("disc", 1), ("time", 3), ("regularised", 3), ("log", 1), ("pair", 2)])
def test_by_matplotlib(view, panels):
    from matplotlib import pyplot

    portrait = ct.portrait(mu=0.3, view=view, u=1, v=1, orbits=4)
    axes = np.atleast_1d(portrait.plot())
    assert len(axes) == panels == len(portrait.figure["panels"])
    pyplot.gcf().canvas.draw()
    for place, panel in zip(axes, portrait.figure["panels"]):
        assert place.get_xlim() == (panel["x"]["low"], panel["x"]["high"])
        drawn = [line for each in place.collections for line in each.get_segments()]
        shown = [line for layer in panel["lines"] for line in layer["lines"] if len(line)]
        assert len(drawn) == len(shown) and all(map(np.array_equal, drawn, shown))
        assert len(place.texts) == len(panel["labels"])
        heads = [way for layer in panel["arrows"] for way in layer["arrows"][1::2] if way.any()]
        assert sum(type(each).__name__ == "FancyArrowPatch" for each in place.patches) == len(heads)
    texts = [text for place in axes for text in place.get_legend_handles_labels()[1]]
    assert len(texts) == len(set(texts)) > 0
    pyplot.close("all")


def test_into_axes_of_ones_own():
    from matplotlib import pyplot

    page, places = pyplot.subplots(2)
    assert ct.portrait(mu=1, orbits=2).plot(ax=places[0]) is places[0] and not places[1].collections
    with pytest.raises(ValueError, match="ax: 2 axes are needed, got 1"):
        ct.portrait(mu=1, orbits=2, view="pair").plot(ax=places[1])
    pyplot.close(page)


@pytest.mark.parametrize("ask, words", [
    (lambda: ct.portrait(mu=1, view="uw"), "no such view 'uw'.*; views: uv, patch, log"),
    (lambda: ct.portrait(mu=1, estimate=True), "estimate is drawn against time: view=.time. is needed"),
    (lambda: ct.portrait(mu=1, view="time", estimate=True, against="pade"), "estimate and against exclude each other"),
    (lambda: ct.portrait(mu=1, arrows="many"), "places: time, one, none"),
    (lambda: ct.portrait(mu=1, u=1), "a start has both u and v"),
    (lambda: ct.portrait(mu=1, ball=ct.Ball.pool()), "exclude each other"),
    (lambda: ct.portrait(mu=1, size="triple"), "single, double, or .width, height. in mm is needed, got 'triple'"),
    (lambda: ct.portrait(mu=1, size=(10, 10)).svg(), "a figure of 10 x 10 mm leaves"),
    (lambda: ct.portrait(mu=1, orbits=-1), "orbits"),
])
def test_rejected_in_the_librarys_own_words(ask, words):
    with pytest.raises(ValueError, match=words):
        ask()


def test_matplotlib_is_imported_only_by_plot():
    code = "import contensou as ct, sys; ct.portrait(mu=1).data; assert 'matplotlib' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
