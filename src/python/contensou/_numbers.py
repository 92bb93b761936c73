"""Tests of arguments."""

from __future__ import annotations

import operator
import sys
from typing import TYPE_CHECKING, Any, Iterable, Protocol, Sequence, Union

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    #: One number, for which one number comes back. Completion by jedi looks one Union deep, and takes no int for a float.
    Number = Union[int, float, np.integer[Any], np.floating[Any]]
    NumberOrNone = Union[int, float, np.integer[Any], np.floating[Any], None]

    class _Dimensions(Protocol):
        @property
        def dims(self) -> Any: ...

    class _Chunks(Protocol):
        @property
        def chunks(self) -> Any: ...

    class _Index(Protocol):
        @property
        def iloc(self) -> Any: ...

    #: Arrays of xarray, dask and pandas, which come back as such.
    Foreign = Union[_Dimensions, _Chunks, _Index]

    class Array(Protocol):
        @property
        def __array__(self) -> Any: ...


def needs(name: str, what: str, given: Any) -> TypeError:
    """Returns the error for an argument of a wrong type."""
    return TypeError(f"{name}: {what} is needed; got {given!r:.60}")


def refuse_unit(name: str, given: Any) -> None:
    """Raises TypeError for a quantity with a unit, and for a list or a DataArray that contains one."""
    parts = given if isinstance(given, (list, tuple)) else (getattr(given, "data", given) if hasattr(type(given), "dims") else given,)
    for each in parts:
        unit = next((unit for unit in ("unit", "units") if hasattr(type(each), unit)), None)
        if unit is not None:
            given_as = f"a {type(each).__name__} of unit '{getattr(each, unit)}'"
            raise TypeError(f"{name}: numbers without a unit are needed; got {given_as}: pass its value")


def _known(array: NDArray[Any]) -> list[Any]:
    """Returns the entries of an array of objects; NA of pandas becomes NaN.
    Raises TypeError for text."""
    pandas = sys.modules.get("pandas")
    entries: list[Any] = array.ravel().tolist()
    if any(isinstance(each, (str, bytes)) for each in entries):
        raise TypeError("text was given")
    return entries if pandas is None else [np.nan if each is pandas.NA else each for each in entries]


def numbers(name: str, given: Any) -> NDArray[np.float64]:
    """Returns the numbers of an argument as one C array of doubles. Masked entries and NA of pandas become NaN.
    Raises TypeError unless they are real numbers (for None, text, dates, complex numbers, numbers with a unit), and
    ValueError for rows of different lengths and numbers beyond doubles."""
    if given is None:
        raise needs(name, "a number, or an array of them,", given)
    if type(given) is not np.ndarray:
        refuse_unit(name, given)
    mask = given.mask if isinstance(given, np.ma.MaskedArray) else False
    try:
        array = np.asarray(given)
    except ValueError:
        raise ValueError(f"{name}: rows of one length are needed; got {given!r:.60}") from None
    if array.dtype.kind not in "fiubO":
        raise TypeError(f"{name}: real numbers are needed, got {array.dtype}")
    try:
        plain = array if array.dtype.kind != "O" else np.array(_known(array), dtype=np.float64).reshape(array.shape)
        result: NDArray[np.float64] = np.asarray(plain, dtype=np.float64, order="C")
    except OverflowError:
        raise ValueError(f"{name}: numbers up to {np.finfo(float).max:.3g} are allowed; got {given!r:.60}") from None
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name}: real numbers are needed; {error}") from None
    return np.where(mask, np.nan, result) if np.any(mask) else result


def number(name: str, given: Any) -> float:
    """Returns an argument that is one number. Raises as numbers."""
    if isinstance(given, (float, int)) and abs(given) < 1e308:
        return float(given)
    result = numbers(name, given)
    if result.ndim != 0:
        raise TypeError(f"{name}: one number is needed, got an array of shape {result.shape}")
    return float(result)


def common_shape(names: Iterable[str], shapes: Sequence[tuple[int, ...]]) -> tuple[int, ...]:
    """Returns the shape to which arrays of these shapes broadcast. Raises ValueError if they do not broadcast."""
    few = set(shapes) - {()}
    try:
        return np.broadcast_shapes(*few) if len(few) > 1 else few.pop() if few else ()
    except ValueError:
        told = ", ".join(f"{name} of {shape}" for name, shape in zip(names, shapes))
        raise ValueError(f"shapes that broadcast are needed; got {told}") from None


def together(**given: Any) -> list[NDArray[np.float64]]:
    """Returns the numbers of several arguments in arrays of one shape.
    Raises ValueError for shapes that do not broadcast."""
    arrays = [numbers(name, each) for name, each in given.items()]
    shape = common_shape(given, [array.shape for array in arrays])
    return [np.broadcast_to(array, shape) for array in arrays]


def text(name: str, given: Any) -> str:
    if not isinstance(given, str):
        raise needs(name, "text", given)
    return given


def flag(name: str, given: Any) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise needs(name, "True or False", given)
    return bool(given)


def whole(name: str, given: Any) -> int:
    try:
        return operator.index(given)
    except TypeError:
        raise TypeError(f"{name}: a whole number is needed, got {given!r:.60}") from None


def target(out: Any, shape: tuple[int, ...], dtype: np.dtype[Any] = np.dtype(np.float64)) -> NDArray[Any]:
    """Returns `out` if it is an array of that shape and dtype for results.
    Raises TypeError or ValueError if it is not."""
    words = str(dtype) if dtype.fields is None else f"a row of {', '.join(dtype.names or ())}"
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out: an array of NumPy is needed, {words} of shape {shape}, got {type(out).__name__}")
    if out.shape != shape or out.dtype != dtype:
        raise ValueError(f"out: {words} of shape {shape} is needed, got {out.dtype} of shape {out.shape}")
    if not out.flags.writeable:
        raise ValueError("out: an array that may be written is needed; this one is read-only: pass a copy of it")
    return out


def thread_count(threads: Any) -> int:
    """Returns a valid number of threads. Raises TypeError or ValueError for any other argument."""
    most = 1024
    count = whole("threads", threads)
    if not 1 <= count <= most:
        raise ValueError(f"threads: a thread or more is needed, at most {most}; got {count}")
    return count
