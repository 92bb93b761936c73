"""What a caller gives as numbers."""

from __future__ import annotations

import operator
from typing import Any

import numpy as np
from numpy.typing import NDArray


def numbers(name: str, given: Any) -> NDArray[np.float64]:
    """The numbers of an argument as one C array of doubles. What is masked in a masked array is NaN.
    Raises TypeError for what are no real numbers: text, dates, complex."""
    mask = given.mask if isinstance(given, np.ma.MaskedArray) else False
    array = np.asarray(given)
    if array.dtype.kind not in "fiubO":
        raise TypeError(f"{name}: real numbers are needed, got {array.dtype}")
    try:
        result: NDArray[np.float64] = np.asarray(array, dtype=np.float64, order="C")
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name}: real numbers are needed; {error}") from None
    return np.where(mask, np.nan, result) if np.any(mask) else result


def number(name: str, given: Any) -> float:
    """The same for one number."""
    result = numbers(name, given)
    if result.ndim != 0:
        raise TypeError(f"{name}: one number is needed, got an array of shape {result.shape}")
    return float(result)


def target(out: Any, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """An array to write results of that shape into.
    Raises TypeError or ValueError for anything else."""
    return target_of(out, shape, np.dtype(np.float64))


def target_of(out: Any, shape: tuple[int, ...], dtype: np.dtype[Any]) -> NDArray[Any]:
    """The same for results of any dtype."""
    words = str(dtype) if dtype.fields is None else f"a row of {', '.join(dtype.names or ())}"
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out: an array of NumPy is needed, {words} of shape {shape}, got {type(out).__name__}")
    if out.shape != shape or out.dtype != dtype:
        raise ValueError(f"out: {words} of shape {shape} is needed, got {out.dtype} of shape {out.shape}")
    return out


def thread_count(threads: Any) -> int:
    """Raises TypeError or ValueError unless it is a number of threads."""
    most = 1024
    try:
        count = operator.index(threads)
    except TypeError:
        raise TypeError(f"threads: a whole number is needed, got {threads!r}") from None
    if not 1 <= count <= most:
        raise ValueError(f"threads: a thread or more is needed, at most {most}; got {count}")
    return count
