"""Arrays of xarray, dask, astropy, pint and pandas: each is what it was, or is refused; none loses its labels or its unit."""

import warnings

import contensou as ct
import numpy as np
import pytest

PATCH = (0.2, 3e-3, 1e-4)
U, V = np.linspace(0.5, 2, 4), np.array([1.0, 2.0, 3.0])

FUNCTIONS = {
    "flow": lambda u: [ct.Flow(mu=0.3).stop_time(u=u, v=1)],
    "stop_time": lambda u: [ct.stop_time(u=1, v=u, mu=0.3)],
    "mu": lambda mu: [ct.stop_time(u=1, v=1, mu=mu)],
    "gradient": lambda u: [(found := ct.stop_time(u=u, v=1, mu=0.3, gradient=True))[0], *found[1].values()],
    "law": lambda k: list(ct.law("exact")(k)),
    "wrench": lambda load: [ct.wrench("exact", (1, 0, 100), load, PATCH)],
    "slopes": lambda load: list(ct.wrench("exact", (1, 0, 100), load, PATCH, slopes=True)),
}
each_function = pytest.mark.parametrize("function", FUNCTIONS.values(), ids=FUNCTIONS)
MUS = U / 2  # numbers for each of them


@each_function
def test_a_data_array_comes_back_as_one(function):
    xarray = pytest.importorskip("xarray")
    given = xarray.DataArray(MUS, dims="place", coords={"place": [10, 20, 30, 40]})
    for result, plain in zip(function(given), function(MUS), strict=True):
        assert isinstance(result, xarray.DataArray) and result.dims[0] == "place"
        np.testing.assert_array_equal(result.place, given.place)
        np.testing.assert_array_equal(result, plain)


def test_data_arrays_go_together_by_their_dimensions():
    xarray = pytest.importorskip("xarray")
    u, v = xarray.DataArray(U, dims="spin"), xarray.DataArray(V, dims="slip")
    mu = xarray.DataArray([0.1, 0.2], dims="ball")
    found = ct.stop_time(u=u, v=v, mu=mu)
    assert found.dims == ("spin", "slip", "ball")
    np.testing.assert_array_equal(found, ct.stop_time(u=U[:, None, None], v=V[:, None], mu=[0.1, 0.2]))
    found = ct.stop_time(u=u, v=1, mu=0.3, where=u > 1)
    assert np.isnan(found).values.tolist() == [True, True, False, False]
    motions = xarray.DataArray(np.ones((4, 3)), dims=("contact", "of"))
    force, slopes = ct.wrench("exact", motions, xarray.DataArray([1.0, 2.0], dims="load"), PATCH, slopes=True)
    assert force.dims == ("contact", "load", "of") and slopes.dims == ("contact", "load", "of", "by_of")
    data = xarray.Dataset({"a": u, "b": 2 * u})
    np.testing.assert_array_equal(ct.stop_time(u=data, v=1, mu=0.3).b, ct.stop_time(u=2 * U, v=1, mu=0.3))
    with pytest.raises(TypeError, match="^out: stop_time of a DataArray returns new arrays"):
        ct.stop_time(u=u, v=1, mu=0.3, out=np.empty(4))


@each_function
def test_dask_stays_lazy(function):
    array = pytest.importorskip("dask.array")
    given = array.from_array(MUS, chunks=3)
    for result, plain in zip(function(given), function(MUS), strict=True):
        assert isinstance(result, array.Array) and result.shape == plain.shape and result.chunks[0] == (3, 1)
        np.testing.assert_array_equal(result.compute(scheduler="threads"), plain)


def test_dask_by_processes_float32_and_chunks_of_two_sizes():
    array = pytest.importorskip("dask.array")
    u, v = array.from_array(U, chunks=3), array.from_array(np.float32(U), chunks=2)
    found = ct.stop_time(u=u, v=v, mu=u / 2)
    np.testing.assert_array_equal(found.compute(scheduler="processes"), ct.stop_time(u=U, v=np.float32(U), mu=U / 2))
    small = ct.stop_time(u=v, v=v, mu=0.3)
    assert small.dtype == small.compute().dtype == np.float32
    motions = array.ones((10, 3), chunks=(4, 2))
    np.testing.assert_array_equal(ct.wrench("exact", motions, 1, PATCH), ct.wrench("exact", np.ones((10, 3)), 1, PATCH))
    np.testing.assert_array_equal(ct.stop_time(u=u, v=1, mu=0.3, where=u > 1), ct.stop_time(u=U, v=1, mu=0.3, where=U > 1))


def test_a_lazy_data_array_stays_lazy():
    xarray, array = pytest.importorskip("xarray"), pytest.importorskip("dask.array")
    found = ct.stop_time(u=xarray.DataArray(U, dims="spin").chunk(2), v=1, mu=0.3)
    assert isinstance(found, xarray.DataArray) and isinstance(found.data, array.Array)
    np.testing.assert_array_equal(found, ct.stop_time(u=U, v=1, mu=0.3))


def quantities(library):
    if library == "astropy":
        units = pytest.importorskip("astropy.units")
        return [U * units.m, 1.0 * units.m / units.s, units.Quantity(U)]
    units = pytest.importorskip("pint").UnitRegistry()
    found = [U * units.m, 1.0 * units.m / units.s, [1.0 * units.m, 2.0 * units.m], U * units.dimensionless]
    try:
        import xarray

        found.append(xarray.DataArray(U * units.m, dims="spin"))
    except ImportError:
        pass
    return found


@pytest.mark.parametrize("library", ["astropy", "pint"])
@each_function
def test_a_unit_is_refused(function, library):
    for given in quantities(library):
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # pint warns where a unit is lost
            with pytest.raises(TypeError, match="numbers without a unit are needed; got a .*Quantity of unit '.*': pass its value"):
                function(given)


@pytest.mark.parametrize("library", ["astropy", "pint"])
@pytest.mark.parametrize("ask", [
    lambda length: ct.Flow(mu=length), lambda length: ct.Flow(mu=0.3).orbit(u=1, v=length), lambda length: ct.Ball.pool().roll(slip=length),
    lambda length: ct.Ball.pool(mass=length), lambda length: ct.stop_time(u=1, v=1, mu=0.3, drive=length)])
def test_no_number_loses_its_unit(ask, library):
    for given in quantities(library):
        if getattr(given, "dims", 1) and str(getattr(given, "unit", "m")):  # a Ball takes float(quantity) if it has no unit
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                with pytest.raises(TypeError):
                    ask(given)


@each_function
def test_what_pandas_does_not_know_is_not_a_number(function):
    pandas = pytest.importorskip("pandas")
    column = pandas.Series([0.25, None, 1], dtype="Float64", index=list("abc"))
    for given in (column, column.array, column.astype(object)):
        for result, plain in zip(function(given), function(np.array([0.25, np.nan, 1])), strict=True):
            assert np.isnan(np.asarray(result, dtype=float)[1]).all()
            np.testing.assert_array_equal(np.asarray(result), plain)
            if plain.ndim == 1 and isinstance(given, pandas.Series):
                assert isinstance(result, pandas.Series) and result.index.tolist() == list("abc") and result.dtype == float
    whole = pandas.Series([1, None], dtype="Int64")
    assert np.isnan(ct.Flow(mu=0.3).orbit(u=1, v=1).slip_length(pandas.Series([1.0]).array)[0]) == False  # noqa: E712
    assert np.isnan(ct.stop_time(u=whole, v=whole, mu=0.3)[1])


@each_function
@pytest.mark.parametrize("kind", [object, "string", "category"])
def test_a_series_of_text_is_refused(function, kind):
    pandas = pytest.importorskip("pandas")
    with pytest.raises(TypeError, match=": real numbers are needed"):
        function(pandas.Series(["1", "2"], dtype=kind))


def test_a_series_keeps_index_and_name():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame({"u": [1.0, 2.0], "v": [0.5, 1.0]}, index=["p", "q"])
    found = ct.stop_time(u=table.u, v=table.v, mu=0.3)
    assert isinstance(found, pandas.Series) and found.index.tolist() == ["p", "q"]
    assert ct.stop_time(u=table, v=1, mu=0.3).columns.tolist() == ["u", "v"]
    motions = pandas.DataFrame(np.ones((4, 3)), columns=["vx", "vy", "omega"])
    assert isinstance(ct.wrench("exact", motions, pandas.Series([1.0] * 4), PATCH), np.ndarray)


def test_events_are_a_table():
    pandas = pytest.importorskip("pandas")
    rolls = ct.Ball.pool(rolling_friction=0.01).roll(slip=[1, 2], spin=50)
    table = pandas.DataFrame(rolls.events)
    pandas.testing.assert_frame_equal(rolls.to_frame(), table)
    assert table.columns.tolist() == list(ct.Rolls.dtype.names) and (table.dtypes == float).all()
    np.testing.assert_array_equal(table.rest_t, rolls.rest["t"])
    assert tuple(table.loc[1, ["rolls_after_t", "rolls_after_x", "rolls_after_y"]]) == rolls[1].rolls_after
    out = np.empty(2, ct.Rolls.dtype)
    ct.Ball.pool(rolling_friction=0.01).roll(slip=[1, 2], spin=50, out=out)
    pandas.testing.assert_frame_equal(pandas.DataFrame(out), table)
