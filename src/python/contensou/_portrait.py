"""Phase portraits."""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path
from typing import Any, Callable, Iterable, Optional, Sequence, Union

import numpy as np

from . import _core
from ._balls import Ball, a_ball
from ._law import Body, LawLike, core_flow, law as law_of
from ._numbers import flag, needs, number, numbers, text, whole

_widths = {"single": 85.0, "double": 170.0}
_kinds: dict[str, Callable[[str, Any], Any]] = {
    **dict.fromkeys(("view", "arrows", "field", "colour", "style", "scale", "title", "font"), text),
    **dict.fromkeys(("axes", "estimate"), flag), **dict.fromkeys(("u", "v", "dpi"), number), "orbits": whole}


def points_of(through: Any) -> list[tuple[float, float]]:
    """Returns the argument through as a list of points."""
    points = numbers("through", list(through) if isinstance(through, Iterable) and not isinstance(through, str) else through)
    if points.size and (points.ndim != 2 or points.shape[1] != 2):
        raise needs("through", "points, [(u, v), ...],", through)
    return [(u, v) for u, v in points.tolist()]


def _columns(value: Any) -> Any:
    """Returns JSON with lists of numbers as arrays; lists of texts stay lists."""
    if isinstance(value, dict):
        return {key: _columns(each) for key, each in value.items()}
    if isinstance(value, list):
        numbers_alone = not value or not isinstance(value[0], (dict, list, str))
        return np.array(value, float) if numbers_alone else [_columns(each) for each in value]
    return value


_Text = tuple[tuple[str, bool, int], ...]


def _mathtext(text: _Text) -> str:
    """Returns a text of a figure in the markup of matplotlib."""
    parts = []
    for words, italic, level in text:
        words = words.replace("$", r"\$")
        if italic or level != 0:
            words = (words if italic else rf"\mathrm{{{words}}}").replace("\u00a0", r"\ ")
            words = f"${words}$" if level == 0 else f"${'^' if level > 0 else '_'}{{{words}}}$"
        parts.append(words)
    return "".join(parts)


def _plain(value: Any) -> Any:
    """Returns numbers or arrays as Python's own numbers and lists."""
    return value if value is None else np.asarray(value).tolist()


class Portrait:
    """A phase portrait; `portrait` and Reduction.portrait make it. A notebook shows its picture."""

    def __init__(self, draw: Callable[[dict[str, Any]], _core.Portrait], asked: dict[str, Any]) -> None:
        self._draw, self._asked = draw, asked
        if (asked["u"] is None) != (asked["v"] is None):
            raise ValueError("a start has both u and v")
        for name, is_kind in _kinds.items():
            if asked.get(name) is not None:
                asked[name] = is_kind(name, asked[name])
        for name in ("window", "isochrones"):
            if isinstance(asked.get(name), (str, bytes)):
                raise TypeError(f"{name}: numbers are needed, got {asked[name]!r}")
        if (window := asked["window"]) is not None and (np.ndim(window) not in (1, 2) or len(window) != 2):
            raise ValueError(f"window: (U, V) or ((U1, U2), (V1, V2)) is needed, got {window!r:.80}")
        if asked["isochrones"] is not None and np.ndim(asked["isochrones"]) > 1:
            raise ValueError("isochrones: a number of them, or their times, is needed")
        dpi, font = asked["dpi"], asked["font"]
        if not 50 <= dpi <= 1200:
            raise ValueError(f"dpi: 50 to 1200 is needed, got {dpi}")
        if any(letter < " " or letter in "'\",;:<>&\\" for letter in font):
            raise ValueError(f"font: the name of a font is needed, as in 'DejaVu Serif', got {font!r}")
        size = asked["size"]
        if isinstance(size, str) and size not in _widths:
            raise ValueError(f"size: single, double, or (width, height) in mm is needed, got {size!r}")
        sides = (_widths[size], None) if isinstance(size, str) else size or (None, None)
        kinds = {"window": _plain(asked["window"]), "isochrones": _plain(asked["isochrones"])}
        self._core = draw(dict(asked, size=sides, **kinds))

    def __reduce__(self) -> tuple[Any, ...]:
        return Portrait, (self._draw, self._asked)

    def __repr__(self) -> str:
        return f"portrait({', '.join(f'{key}={value!r}' for key, value in self._asked.items() if value is not None)})"

    def render(self, format: str) -> bytes:
        """Returns the file in a format: svg, pdf, png, eps (by gnuplot on PATH), gp (gnuplot script), tex (LaTeX)."""
        return self._core.render(format, self._asked["font"], self._asked["dpi"])

    def save(self, path: Union[str, PathLike[str]]) -> None:
        """Writes the file in the format of its ending."""
        Path(path).write_bytes(self.render(Path(path).suffix[1:]))

    def svg(self) -> str:
        return self.render("svg").decode()

    _repr_svg_ = svg

    @property
    def data(self) -> dict[str, Any]:
        """The content of `contensou portrait -o FILE.json`, with lists of numbers as arrays. `contensou help fields`
        describes the members."""
        return dict(_columns(json.loads(self._core.json())))

    @property
    def figure(self) -> dict[str, Any]:
        """The drawing as data: title, and panels with axes, lines, arrows, marks, labels and regions in the units of
        the axes. A text is a tuple of runs (words, italic, level); level is 1 for a power, -1 for an index, else 0."""
        return self._core.figure()

    def plot(self, ax: Any = None) -> Any:
        """Plots the figure by matplotlib into `ax`, one axes object for each panel, with the size of letters set there,
        or into a new figure. The scale of colours stands beside it, the legend below. Returns the axes, or an array of
        them for several panels."""
        from matplotlib import pyplot, rcParams, rc_context

        figure = self.figure
        count = len(figure["panels"])
        if ax is not None:
            places = np.ravel(ax)
            if len(places) != count:
                raise ValueError(f"ax: {count} axes are needed, got {len(places)}")
            self._fill(figure, places, rcParams["font.size"], None)
            return ax
        # The layout is that of the library: side by side if each panel has 50 mm, in rows of one length.
        columns = next(each for each in range(count, 0, -1) if each == 1 or (count % each == 0 and figure["width_mm"] >= 50 * each))
        with rc_context({"font.size": figure["letter_pt"]}):
            page, ax = pyplot.subplots(
                count // columns, columns, figsize=(figure["width_mm"] / 25.4, figure["height_mm"] / 25.4),
                facecolor=figure["ground"], layout="constrained")
            page.suptitle(_mathtext(figure["title"]), color=figure["ink"])
            self._fill(figure, np.ravel(ax), figure["letter_pt"], page)
        return ax

    def _fill(self, figure: dict[str, Any], places: Any, letter: float, page: Any) -> None:
        """Draws the panels; lines, marks and heads are proportional to letters of a size in points.

        page:  the figure, if this portrait made it"""
        from matplotlib.cm import ScalarMappable
        from matplotlib.collections import LineCollection
        from matplotlib.colors import ListedColormap

        for panel, place in zip(figure["panels"], places):
            place.set(title=_mathtext(panel["title"]), facecolor=figure["ground"])
            if panel["bare"]:
                place.set_axis_off()
            for name in "xy":
                axis = panel[name]
                place.set(**{f"{name}lim": (axis["low"], axis["high"]), f"{name}label": _mathtext(axis["name"])})
                if axis["ticks"]:
                    ticks, texts = zip(*axis["ticks"])
                    place.set(**{f"{name}ticks": ticks, f"{name}ticklabels": [_mathtext(text) for text in texts]})
            if panel["to_scale"]:
                place.set_aspect("equal")
            for region in panel["regions"]:
                place.fill(*region["border"].T, color=region["colour"], linewidth=0, zorder=0)
            for layer in panel["lines"]:
                style = "-." if layer["dashed"] and layer["dotted"] else "--" if layer["dashed"] else ":" if layer["dotted"] else "-"
                place.add_collection(LineCollection(
                    layer["lines"], colors=layer["colour"], linewidths=0.074 * letter * layer["width"], linestyles=style,
                    label=_mathtext(layer["legend"]) or None), autolim=False)
            for layer in panel["arrows"]:
                self._arrows(place, panel, layer, letter)
            for layer in panel["marks"]:
                shape = {"dot": "o", "circle": "o", "square": "s", "diamond": "D"}[layer["shape"]]
                inside = layer["colour"] if layer["shape"] == "dot" else figure["ground"]
                place.plot(*layer["points"].T, shape, color=layer["colour"], markerfacecolor=inside, clip_on=False,
                           markersize=0.5 * letter * layer["size"], label=_mathtext(layer["legend"]) or None)
            for label in panel["labels"]:
                place.text(label["x"], label["y"], _mathtext(label["text"]), color=label["colour"], ha=label["align"],
                           va="center", fontsize=0.85 * letter, bbox={"facecolor": figure["ground"], "lw": 0, "pad": 0.5})
        self._legend(places, letter, page)
        if bar := figure["colour_bar"]:
            scale = places[0].get_figure().colorbar(
                ScalarMappable(cmap=ListedColormap(bar["colours"])), ax=list(places), label=_mathtext(bar["name"]),
                use_gridspec=page is not None)
            scale.set_ticks([at for at, _ in bar["ticks"]], labels=[_mathtext(text) for _, text in bar["ticks"]])

    @staticmethod
    def _legend(places: Any, letter: float, page: Any) -> None:
        """Draws each text once, below the page, or below the caller's axes, which shrink without a layout engine."""
        from matplotlib.transforms import ScaledTranslation

        entries: dict[str, dict[type, Any]] = {}  # for each text a line, a mark, or both
        for place in places:
            for handle, text in zip(*place.get_legend_handles_labels()):
                entries.setdefault(text, {}).setdefault(type(handle), handle)
        if not entries:
            return
        first = places[0].get_figure()
        width = 72 / first.dpi * (first if page is not None else places[0]).get_window_extent().width
        longest = max(len(text.replace("\\mathrm", "")) for text in entries)
        columns = int(np.clip(width / (letter * (0.55 * longest + 3.5)), 1, len(entries)))
        look = {"handles": [tuple(handles.values()) for handles in entries.values()], "labels": list(entries), "ncols": columns,
                "fontsize": 0.85 * letter, "frameon": False}
        rows = -(-len(entries) // columns)
        height = (1.6 * rows + 0.5) * letter / 72 / first.get_figheight()
        if page is not None:
            page.get_layout_engine().set(rect=(0, height, 1, 1 - height))
            page.legend(loc="lower center", **look)
            return
        if first.get_layout_engine() is None:
            for place in places:
                box = place.get_position()
                place.set_position([box.x0, box.y0 + height, box.width, box.height - height])
        below = ScaledTranslation(0, -3.4 * letter / 72, first.dpi_scale_trans)
        places[0].legend(loc="upper center", bbox_to_anchor=(0.5, 0), bbox_transform=places[0].transAxes + below,
                         borderpad=0, **look)

    @staticmethod
    def _arrows(place: Any, panel: dict[str, Any], layer: dict[str, Any], letter: float) -> None:
        """Draws arrow heads of one size, each on a shaft of a thousandth of the axes, whatever the size of the axes."""
        from matplotlib.patches import FancyArrowPatch

        span = np.array([panel[name]["high"] - panel[name]["low"] for name in "xy"])
        at, direction = layer["arrows"][::2], layer["arrows"][1::2]
        at, way = at[direction.any(axis=1)], direction[direction.any(axis=1)] / span
        way *= 1e-3 * span / np.abs(way).max(axis=1, keepdims=True)
        for head, tail in zip(at, at - way):
            place.add_patch(FancyArrowPatch(tail, head, arrowstyle="-|>,head_length=0.74,head_width=0.24", mutation_scale=letter,
                                            shrinkA=0, shrinkB=0, color=layer["colour"], linewidth=0.5, clip_on=False))


def _of_system(asked: dict[str, Any]) -> _core.Portrait:
    ball, law, against = asked["ball"], asked["law"], asked["against"]
    experiment = None if ball is None else a_ball(ball)._experiment
    laws = law if isinstance(law, (list, tuple)) else [law]
    many_mu = asked["mu"] if np.ndim(asked["mu"]) == 1 else [asked["mu"]]
    if not len(laws) or not len(many_mu):
        raise ValueError("mu and law: one, or a list of one or more, is needed")
    if experiment is None:
        flows = [core_flow(mu, each, asked["body"], asked["drive"]) for each in laws for mu in many_mu]
    elif asked["mu"] is None and asked["u"] is None and asked["v"] is None and asked["body"] == "ball" and asked["drive"] == 0:
        flows = [experiment.flow(ball._law(each)._core) for each in laws]
    else:
        raise ValueError("ball and mu, u, v, body, drive exclude each other: a ball brings them")
    return _core.Portrait(flows, experiment, None if against is None else law_of(against)._core, asked)


def portrait(
    *,
    mu: Union[None, float, Sequence[float]] = None,
    law: Union[None, LawLike, Sequence[LawLike]] = None,
    body: Body = "ball",
    drive: float = 0,
    u: Optional[float] = None,
    v: Optional[float] = None,
    ball: Optional[Ball] = None,
    view: Optional[str] = None,
    window: Union[None, tuple[float, float], tuple[tuple[float, float], tuple[float, float]]] = None,
    orbits: Optional[int] = None,
    through: Iterable[tuple[float, float]] = (),
    isochrones: Union[None, int, Sequence[float]] = None,
    against: Optional[LawLike] = None,
    arrows: str = "time",
    field: str = "none",
    axes: bool = True,
    colour: str = "time",
    style: str = "print",
    scale: str = "bent",
    estimate: bool = False,
    size: Union[None, str, tuple[float, float]] = None,
    title: Optional[str] = None,
    font: str = "",
    dpi: float = 300,
) -> Portrait:
    """Returns the phase portrait of a system, as in Flow, or of a ball in SI units, as `contensou portrait` draws it.

    mu, law:     a value, or a list: one plane for each, side by side in one frame, with one scale of colours
    u, v:        start of an orbit to highlight
    view:        uv, patch, log, similarity, blowup, disc, time, regularised, pair
    window:      (U, V): show |u| <= U and v <= V; in the views uv, patch and pair also ((U1, U2), (V1, V2))
    orbits:      number of orbits on each side of u = 0
    through:     points (u, v) whose orbits are shown, too
    isochrones:  approximate number of lines of equal stop time, or their times, for a ball in s
    against:     another law, in the same figure
    arrows:      time, one or none
    field:       none, motion or regularised
    axes:        True to draw the invariant axes and rays
    colour:      time for orbits coloured by the time left, none for one colour
    style:       print or screen
    scale:       bent or linear
    estimate:    in the view of time, draw the approximation for small mu beside each motion, dashed
    size:        (width, height) in mm, or single, double for the columns of a journal
    title:       "" for neither title nor subtitle
    font, dpi:   font of all files except tex; dots per inch of a png
    """
    asked = dict(locals(), through=points_of(through))
    return Portrait(_of_system, asked)
