"""Tables and pictures for notebooks."""

from __future__ import annotations

from html import escape
from io import StringIO
from typing import Any, Callable, Iterable, Optional, Sequence

import numpy as np


def words(value: Any) -> str:
    """Returns a value as text for a cell of a table; a number has six digits."""
    return f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value)


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Returns a table in HTML."""
    lines = ["".join(f"<td>{escape(words(each))}</td>" for each in row) for row in rows]
    heads = "".join(f"<th>{escape(each)}</th>" for each in head)
    body = "\n".join(f"<tr>{line}</tr>" for line in lines)
    return f"<table><caption>{escape(caption)}</caption>\n<thead><tr>{heads}</tr></thead>\n<tbody>{body}</tbody></table>"


def picture(plot: Callable[[], Any]) -> Optional[str]:
    """Returns the figure that `plot` draws by matplotlib, as SVG; None if matplotlib is not installed."""
    try:
        from matplotlib import pyplot, rc_context
    except ImportError:
        return None
    text = StringIO()
    with rc_context({"svg.fonttype": "none"}), pyplot.ioff():
        figure = np.ravel(plot())[0].get_figure()
        figure.savefig(text, format="svg", bbox_inches="tight")
        pyplot.close(figure)
    return text.getvalue()


def with_picture(html: str, svg: Optional[str]) -> str:
    """Returns HTML with a picture below, because a notebook shows HTML or SVG, not both."""
    return html if svg is None else f"{html}\n<div>{svg[svg.index('<svg'):]}</div>"
