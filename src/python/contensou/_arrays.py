"""Functions that take arrays as the ufuncs of NumPy do."""

from __future__ import annotations

import sys
from typing import Any, Callable, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from ._numbers import common_shape, numbers, refuse_unit, target

_own = np.ndarray.__array_ufunc__

#: Types that have neither a unit nor an __array_ufunc__ of their own, for speed.
_plain = frozenset((np.ndarray, float, int, list, tuple, np.float64, np.float32))

_double: np.dtype[Any] = np.dtype(np.float64)
_small: tuple[np.dtype[Any], ...] = (np.dtype(np.float32), np.dtype(np.float16))


class ArrayFunction:
    """A function of numbers that takes arrays as a ufunc of NumPy does.

    Arguments broadcast. `out` and `where` are those of a ufunc; without `out`, the result is NaN where `where` is False.
    float32 gives float32, computed in double. An array with its own __array_ufunc__ decides about the result: a DataArray
    comes back as one, and dask stays lazy. An array with a unit raises TypeError.

    name, arguments:  for messages
    compute:  writes results, the last positional arguments, of the arguments before them: arrays of doubles of one shape,
              plus the axes of along. dask and processes need one that can be pickled
    along:    names of the numbers along the last axis of the first argument; () if it has no such axis
    gives:    for each result the number of its last axes that have the size of along
    """

    def __init__(self, name: str, arguments: Sequence[str], compute: Callable[..., None], along: Sequence[str] = (),
                 gives: Sequence[int] = (0,)) -> None:
        self.__name__ = name
        self.nin, self.nout = len(arguments), len(gives)
        self._arguments, self._compute, self._along, self._gives = tuple(arguments), compute, tuple(along), tuple(gives)
        self._takes = [1 if along and i == 0 else 0 for i in range(self.nin)]

    @property
    def signature(self) -> Optional[str]:
        """The signature of a generalized ufunc; None for a ufunc."""
        return self._axes(self._takes) + "->" + self._axes(self._gives) if self._along else None

    @staticmethod
    def _axes(counts: Sequence[int]) -> str:
        return ",".join(f"({','.join('ij'[:count])})" for count in counts)

    def __call__(self, *given: Any, out: Any = None, where: Any = True) -> Any:
        outs = () if out is None else out if isinstance(out, tuple) else (out,)
        if outs and len(outs) != self.nout:
            raise ValueError(f"out: {self.nout} arrays are needed, got {len(outs)}")
        if any(type(each) not in _plain for each in (*given, *outs)):
            for name, each in zip(self._arguments, given):
                refuse_unit(name, each)
            if any(self._decides(each) for each in (*given, *outs)):
                return self._elsewhere(given, outs, where)
        return self._here(given, outs, where)

    def _decides(self, given: Any) -> bool:
        """Returns True for an array whose own __array_ufunc__ decides about the result."""
        method = getattr(type(given), "__array_ufunc__", _own)
        if method is _own or isinstance(given, np.ma.MaskedArray):
            return False
        pandas = sys.modules.get("pandas")
        # A nullable column becomes NaN here. pandas has no objects with more axes than its own.
        return pandas is None or not (isinstance(given, pandas.api.extensions.ExtensionArray)
                                      or self._along and isinstance(given, (pandas.Series, pandas.DataFrame)))

    def _elsewhere(self, given: Sequence[Any], outs: tuple[Any, ...], where: Any) -> Any:
        """Lets xarray, dask or another kind of array call this function for its parts."""
        for call in (self._by_xarray, self._by_dask):
            if (result := call(given, outs, where)) is not NotImplemented:
                return result
        options: dict[str, Any] = {"out": outs} if outs else {}
        if where is not True:
            options["where"] = where
        for each in (*given, *outs):
            method: Any = getattr(type(each), "__array_ufunc__", _own) if self._decides(each) else _own
            if method is None:
                break
            if method is not _own and (result := method(each, self, "__call__", *given, **options)) is not NotImplemented:
                return result
        kinds = ", ".join(type(each).__name__ for each in (*given, *outs))
        raise TypeError(f"{self.__name__}: these arrays do not go together: {kinds}")

    def _masked(self, *given: Any) -> Any:
        return self(*given[:-1], where=given[-1])

    def _parts(self, given: Sequence[Any], outs: tuple[Any, ...], where: Any, kind: str) -> tuple[Any, list[Any], list[int]]:
        """Returns the function to call for parts of arrays, its arguments, and how many last axes each has."""
        if outs:
            raise TypeError(f"out: {self.__name__} of {kind} returns new arrays: leave out out")
        if where is True:
            return self, list(given), self._takes
        return self._masked, [*given, where], [*self._takes, 0]

    def _by_xarray(self, given: Sequence[Any], outs: tuple[Any, ...], where: Any) -> Any:
        xarray: Any = sys.modules.get("xarray")
        kinds = () if xarray is None else (xarray.DataArray, xarray.Dataset, xarray.Variable)
        if not any(isinstance(each, kinds) for each in (*given, *outs)):
            return NotImplemented
        function, parts, takes = self._parts(given, outs, where, "a DataArray")
        along = str(given[0].dims[-1]) if self._along and isinstance(given[0], kinds) else "component"
        names = along, f"by_{along}"
        return xarray.apply_ufunc(function, *parts, input_core_dims=[names[:count] for count in takes],
                                  output_core_dims=[names[:count] for count in self._gives], dask="allowed")

    def _by_dask(self, given: Sequence[Any], outs: tuple[Any, ...], where: Any) -> Any:
        dask: Any = sys.modules.get("dask.array")
        if dask is None or not any(isinstance(each, dask.Array) for each in (*given, *outs)):
            return NotImplemented
        function, parts, takes = self._parts(given, outs, where, "dask")
        parts = [np.asarray(each) if isinstance(each, (list, tuple)) else each for each in parts]
        dtypes = [self._dtype(given)] * self.nout
        return dask.apply_gufunc(
            function, self._axes(takes) + "->" + self._axes(self._gives), *parts, allow_rechunk=True,
            output_dtypes=dtypes if self.nout > 1 else dtypes[0], output_sizes={"j": len(self._along)})

    @staticmethod
    def _dtype(given: Sequence[Any]) -> np.dtype[Any]:
        """Returns float32 where NumPy would compute in it or in float16, else float64."""
        if not any(getattr(each, "dtype", _double) in _small for each in given):
            return _double
        found = np.result_type(*(each if isinstance(each, (float, int)) else getattr(each, "dtype", None) or np.asarray(each)
                                 for each in given))
        return _small[0] if found in _small else _double

    def _arrays(self, given: Sequence[Any]) -> tuple[list[NDArray[np.float64]], tuple[int, ...]]:
        """Returns the arguments in arrays of one shape, and this shape without the last axis of the first."""
        arrays = [numbers(name, each) for name, each in zip(self._arguments, given)]
        size = len(self._along)
        if self._along and (arrays[0].ndim == 0 or arrays[0].shape[-1] != size):
            raise ValueError(f"{self._arguments[0]}: {', '.join(self._along)} along the last axis are needed; "
                             f"got an array of shape {arrays[0].shape}")
        ends = [array.ndim - count for array, count in zip(arrays, self._takes)]
        shape = common_shape(self._arguments, [array.shape[:end] for array, end in zip(arrays, ends)])
        return [array if array.shape[:end] == shape else np.broadcast_to(array, shape + array.shape[end:])
                for array, end in zip(arrays, ends)], shape

    def _here(self, given: Sequence[Any], outs: tuple[Any, ...], where: Any) -> Any:
        arrays, shape = self._arrays(given)
        shapes = [shape + (len(self._along),) * count for count in self._gives]
        dtype = self._dtype(given)
        for each, full in zip(outs, shapes):
            target(each, full, _double if getattr(each, "dtype", None) == _double else dtype)
        if where is not True:
            results = outs or tuple(np.full(full, np.nan, dtype) for full in shapes)
            self._write_where(where, arrays, results, shape)
        else:
            results = outs or tuple(np.empty(full, dtype) for full in shapes)
            into = [each if each.dtype == _double and (not outs or self._is_direct(each, arrays)) else np.empty(each.shape)
                    for each in results]
            self._compute(*arrays, *into)
            for each, found in zip(results, into):
                if found is not each:
                    each[...] = found
        found_all = results if outs else tuple(each[()] for each in results)
        return found_all[0] if self.nout == 1 else found_all

    def _write_where(self, where: Any, arrays: Sequence[NDArray[np.float64]], results: Sequence[NDArray[Any]],
                     shape: tuple[int, ...]) -> None:
        asked = np.asarray(where)
        if asked.dtype != bool:
            raise TypeError(f"where: True or False is needed for each entry; got {asked.dtype}")
        try:
            asked = np.broadcast_to(asked, shape)
        except ValueError:
            raise ValueError(f"where: a shape that broadcasts to {shape} is needed; got {asked.shape}") from None
        found = [np.empty((np.count_nonzero(asked), *each.shape[len(shape):])) for each in results]
        self._compute(*(array[asked] for array in arrays), *found)
        for each, values in zip(results, found):
            each[asked] = values

    @staticmethod
    def _is_direct(result: NDArray[Any], arrays: Sequence[NDArray[np.float64]]) -> bool:
        """Returns True if results may be written to this array entry by entry while the arguments are read."""
        return result.flags.c_contiguous and all(
            not np.may_share_memory(result, each)
            or result.ctypes.data == each.ctypes.data and result.shape == each.shape and each.flags.c_contiguous
            for each in arrays)
