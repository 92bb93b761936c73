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
    ({"mu": 0.5, "window": ((-0.2, 1), (0.1, 0.6)), "isochrones": [1, 2.5, 5], "through": [(0.5, 0.3), (0.2, 0.2)], "view": "patch"},
     ["--mu", "0.5", "--window=-0.2:1,0.1:0.6", "--isochrones", "5,1,2.5", "--through", "0.5,0.3", "--through", "0.2,0.2", "--view",
      "patch"]),
    ({"mu": [0.05, 0.3, 1], "law": ["exact", "pade"], "u": 0.5, "v": 0.4, "size": "double"},
     ["--mu", "0.05,0.3,1", "--law", "exact,pade", "--u0", "0.5", "--v0", "0.4", "--size", "double"]),
    ({"ball": ct.Ball.pool(), "law": ["exact", "pade"], "view": "log"}, ["--ball", "pool", "--law", "exact,pade", "--view", "log"]),
    ({"ball": ct.Ball.pool(slip=2), "isochrones": [2.0]}, ["--ball", "pool", "--slip", "2", "--isochrones", "2,"]),
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
    texts = {text for place in axes for text in place.get_legend_handles_labels()[1]}
    assert sorted(text.get_text() for text in pyplot.gcf().legends[0].get_texts()) == sorted(texts) != []
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


def test_isochrones_of_ones_own_and_a_window_with_four_ends():
    portrait = ct.portrait(mu=0.5, window=((-0.2, 1), (0.1, 0.6)), isochrones=[1, 2.5, 4], law="pade")
    data = portrait.data
    assert [side.tolist() for side in data["window"]] == [[-0.2, 1], [0.1, 0.6]]
    assert [line["tau_stop"] for line in data["isochrones"]][0] == 1 and {float(line["tau_stop"]) for line in data["isochrones"]} <= {1, 2.5, 4}
    for line in data["isochrones"]:
        assert line["u"].min() >= -0.2 and line["u"].max() <= 1 and line["v"].min() >= 0.1 and line["v"].max() <= 0.6
        np.testing.assert_allclose(ct.stop_time(u=line["u"], v=line["v"], mu=0.5, law="pade"), line["tau_stop"], rtol=1e-9)
    for orbit in data["orbits"]:
        assert ((orbit["u"] >= -0.2) & (orbit["u"] <= 1) & (orbit["v"] >= 0.1) & (orbit["v"] <= 0.6)).any()
    panel, = portrait.figure["panels"]
    assert (panel["x"]["low"], panel["x"]["high"], panel["y"]["low"], panel["y"]["high"]) == (-0.2, 1, 0.1, 0.6)
    assert not any("stop" in str(layer["legend"]) for layer in panel["marks"])
    with pytest.raises(ValueError, match="of the views uv, patch and pair; disc"):
        ct.portrait(mu=0.5, view="disc", window=((0, 1), (0, 1)))
    with pytest.raises(ValueError, match="the point .* lies outside the window"):
        ct.portrait(mu=0.5, window=((0, 1), (0, 1)), through=[(-0.5, 0.5)])
    with pytest.raises(ValueError, match="time of an isochrone must be > 0"):
        ct.portrait(mu=0.5, isochrones=[1, 0])
    with pytest.raises(ValueError, match="no state in the window .* in its corner it is"):
        ct.portrait(mu=0.5, isochrones=[1e9])


def numbers_on(figure, panel=0):
    return ["".join(words for words, _, _ in label["text"]) for label in figure["panels"][panel]["labels"]]


@pytest.mark.parametrize("mu, size", [(0.05, "single"), (0.01, "single"), (0.3, None), (1, "single")])
def test_every_isochrone_has_its_number(mu, size):
    portrait = ct.portrait(mu=mu, size=size)
    times = sorted({float(line["tau_stop"]) for line in portrait.data["isochrones"]})
    assert sorted(float(each) for each in numbers_on(portrait.figure)) == pytest.approx(times)


def test_points_of_ones_own_are_numbered_and_colours_change_in_round_steps():
    figure = ct.portrait(mu=0.3, isochrones=0, through=[(0.5, 1), (-0.5, 1)]).figure
    assert numbers_on(figure) == ["1", "2"]
    for mu in (0.05, 0.3, 1):
        figure = ct.portrait(mu=mu).figure
        ticks = figure["colour_bar"]["ticks"]
        first, second = (float(text[0][0]) for _, text in ticks[:2])
        step = (second - first) / round((ticks[1][0] - ticks[0][0]) * len(figure["colour_bar"]["colours"]))
        digits = step / 10.0 ** np.floor(np.log10(step) + 1e-9)
        assert min(abs(digits - each) for each in (1, 2, 2.5, 5)) < 1e-9
    powers = [text[-1][0] for _, text in ct.portrait(mu=0.05).figure["panels"][0]["y"]["ticks"] if len(text) > 1]
    assert all(float(power) >= -30 for power in powers)


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_several_planes_have_one_window_and_one_scale_of_colours(tmp_path):
    def portrait(*options, ending):
        path = tmp_path / f"figure.{ending}"
        subprocess.run([PROGRAM, "portrait", *options, "-o", str(path)], check=True, capture_output=True)
        return path.read_text()

    import csv, json
    several = json.loads(portrait("--mu", "0.05,0.3,1", "--scale", "linear", ending="json"))
    assert several["schema"] == 1 and [each["mu"] for each in several["portraits"]] == [0.05, 0.3, 1]
    windows = {tuple(each["window"]) for each in several["portraits"]}
    assert len(windows) == 1
    u, v = windows.pop()
    for each in several["portraits"]:
        alone = json.loads(portrait("--mu", str(each["mu"]), "--window", f"{u},{v}", "--orbits", "8", "--scale", "linear",
                                    ending="json"))
        assert each["orbits"] == alone["orbits"]
        for line in each["isochrones"]:
            np.testing.assert_allclose(ct.stop_time(u=line["u"], v=line["v"], mu=each["mu"]), line["tau_stop"], rtol=1e-9)
    times = [sorted({line["tau_stop"] for line in each["isochrones"]}) for each in several["portraits"]]
    np.testing.assert_allclose(times, [[10, 20, 50], [2, 5, 10], [0.5, 1, 2]])  # each has its last three of one series
    figure = ct.portrait(mu=[0.05, 0.3, 1]).figure
    assert numbers_on(figure, 1) == ["2", "5", "10"]
    axes = [[(panel[axis]["low"], panel[axis]["high"]) for axis in "xy"] for panel in figure["panels"]]
    assert axes == [axes[0]] * 3
    rows = list(csv.DictReader(line for line in portrait("--mu", "0.3", "--law", "exact,pade", ending="csv").splitlines()
                               if not line.startswith("#")))
    assert {row["law"] for row in rows} == {"exact", "pade"} and {row["mu"] for row in rows} == {"0.3"}
    assert portrait("--mu", "0.3", ending="json") == portrait("--mu", "0.3", "--law", "exact", ending="json")
    rims = ct.portrait(mu=[0.1, 0.5], view="patch").figure["panels"]  # one frame of rim speeds
    assert rims[0]["x"]["high"] == pytest.approx(rims[1]["x"]["high"]) and rims[0]["y"]["high"] == pytest.approx(rims[1]["y"]["high"])


@pytest.mark.skipif(not PROGRAM, reason="the program is not built")
def test_stop_times_by_several_laws_side_by_side():
    def batch(*options, rows="mu,u0,v0\n0.1,1,1\n0.3,-1,2\n"):
        return subprocess.run([PROGRAM, "stop", "--batch", "-", *options], input=rows, capture_output=True, text=True)

    lines = batch("--law", "exact,pade").stdout.splitlines()
    assert lines[0] == "mu,u0,v0,tau_stop_exact,tau_stop_pade"
    for law, column in (("exact", 3), ("pade", 4)):
        alone = batch("--law", law).stdout.splitlines()
        assert [line.split(",")[column] for line in lines[1:]] == [line.split(",")[3] for line in alone[1:]]
    shots = "slip,spin\n1,100\n2,-30\n"
    both = batch("--ball", "pool", "--law", "exact,pade", rows=shots).stdout.splitlines()
    assert both[0] == "slip,spin,t_stop_exact,t_stop_pade"
    for law, column in (("exact", 2), ("pade", 3)):
        alone = batch("--ball", "pool", "--law", law, rows=shots).stdout.splitlines()
        assert [line.split(",")[column] for line in both[1:]] == [line.split(",")[2] for line in alone[1:]]
    twice = batch("--law", "pade,pade")
    assert twice.returncode == 2 and "there twice" in twice.stderr


def test_font_and_dpi_are_of_files():
    portrait = ct.portrait(mu=1, orbits=3, font="DejaVu Serif", dpi=100)
    assert b"DejaVu Serif" in portrait.render("svg")
    width = int.from_bytes(portrait.render("png")[16:20], "big")
    assert width == pytest.approx(portrait.figure["width_mm"] / 25.4 * 100, abs=2)
    for given in ({"dpi": 10}, {"font": "a;b"}, {"window": (1, 2, 3)}, {"isochrones": [[1]]}):
        with pytest.raises(ValueError, match=next(iter(given))):
            ct.portrait(mu=1, **given)
    with pytest.raises(TypeError) as caught:
        ct.portrait(mu=1, orbits=1.5)
    assert "_core" not in str(caught.value) and "incompatible" not in str(caught.value)


@pytest.mark.parametrize("own", [True, False])
def test_colour_bar_and_legend_stand_beside_the_axes_and_on_the_page(own):
    from matplotlib import pyplot

    page, ax = pyplot.subplots() if own else (None, None)
    ax = ct.portrait(mu=0.3, through=[(0.5, 0.5)], size="single").plot(ax)
    page = ax.get_figure()
    page.canvas.draw()
    bar, = (each for each in page.axes if each is not ax)
    legend = (ax.get_legend() if own else page.legends[0]).get_window_extent()
    assert bar.get_window_extent().x0 > ax.get_window_extent().x1
    assert page.bbox.y0 <= legend.y0 and legend.y1 <= ax.xaxis.label.get_window_extent().y0
    assert page.bbox.x0 <= legend.x0 and legend.x1 <= page.bbox.x1
    assert ax.yaxis.label.get_fontsize() == pytest.approx(10 if own else 6.65, abs=0.05)
