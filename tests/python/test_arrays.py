"""Stop times, laws and wrenches of arrays, as NumPy's users know them from ufuncs: out, where, float32, and arrays that decide
themselves. full/test_libraries.py does the same with the libraries."""

import contensou as ct
import numpy as np
import pytest

PATCH = (0.2, 3e-3, 1e-4)
MOTION = np.float32([1, 0, 100])
U = np.array([1.0, 2.0, 3.0])

#: Each function of one array: its results as a list.
FUNCTIONS = {
    "flow": lambda u, **more: [ct.Flow(mu=0.3).stop_time(u=u, v=1, **more)],
    "stop_time": lambda u, **more: [ct.stop_time(u=u, v=1, mu=0.3, **more)],
    "mu": lambda mu, **more: [ct.stop_time(u=1, v=1, mu=mu / 4, **more)],
    "law": lambda k, **more: list(ct.law("exact")(k, **more)),
    "wrench": lambda load, **more: [ct.wrench("exact", MOTION, load, PATCH, **more)],
    "slopes": lambda load, **more: list(ct.wrench("uniform", MOTION, load, PATCH, slopes=True, **more)),
}
each_function = pytest.mark.parametrize("function", FUNCTIONS.values(), ids=FUNCTIONS)


def given_as_out(arrays):
    return tuple(arrays) if len(arrays) > 1 else arrays[0]


@each_function
def test_float32_gives_float32_rounded_once(function):
    exact = function(np.float32(U).astype(float))
    for result, full in zip(function(np.float32(U)), exact, strict=True):
        assert result.dtype == np.float32 and result.shape == full.shape
        np.testing.assert_allclose(result, full, rtol=6e-8 if function is not FUNCTIONS["mu"] else 3e-7)
    for other in (U, [1, 2, 3], np.array([1, 2, 3]), np.array([1, 2, 3], object)):
        assert all(result.dtype == np.float64 for result in (function(other) if not isinstance(other, list) else function(np.asarray(other))))
    out = [np.zeros(each.shape, np.float32) for each in exact]
    found = function(np.float32(U), out=given_as_out(out))
    assert all(a is b and a.all() == b.all() for a, b in zip(found, out, strict=True))
    with pytest.raises(ValueError, match=r"^out: float64 of shape \(3,.* is needed, got float32"):
        function(U, out=given_as_out(out))
    function(np.float32(U), out=given_as_out([np.zeros(each.shape) for each in exact]))  # no number is lost
    for each in out:
        each.flags.writeable = False
    with pytest.raises(ValueError, match="^out: an array that may be written is needed; this one is read-only"):
        function(np.float32(U), out=given_as_out(out))


def test_float32_beside_double_is_double():
    assert ct.stop_time(u=np.float32(U), v=U, mu=0.3).dtype == np.float64
    assert ct.stop_time(u=np.float32(U), v=[1, 2, 3], mu=0.3).dtype == np.float64
    assert ct.stop_time(u=np.float16([1, 2]), v=1, mu=0.3).dtype == np.float32


@each_function
def test_where_computes_these_entries_alone(function):
    full, where = function(U), [True, False, True]
    for result, whole in zip(function(U, where=where), full, strict=True):
        np.testing.assert_array_equal(result[[0, 2]], whole[[0, 2]])
        assert np.isnan(result[1]).all()
    out = [np.full_like(each, 7) for each in full]
    for result, whole, kept in zip(function(U, where=where, out=given_as_out(out)), full, out, strict=True):
        assert result is kept and (result[1] == 7).all()
        np.testing.assert_array_equal(result[[0, 2]], whole[[0, 2]])
    assert all(np.isnan(each).all() for each in function(U, where=False))
    assert all(np.array_equal(a, b) for a, b in zip(function(U, where=np.True_), full))
    with pytest.raises(TypeError, match="^where: True or False is needed for each entry; got int64"):
        function(U, where=[1, 0, 1])
    with pytest.raises(ValueError, match=r"^where: a shape that broadcasts to \(3,\) is needed; got \(2,\)"):
        function(U, where=[True, False])


def test_where_leaves_out_what_would_be_refused():
    patch = (np.array([0.2, -1.0]), 3e-3, 1e-4)
    forces = ct.wrench("exact", (1, 0, 100), 1.7, patch, where=patch[0] >= 0)
    np.testing.assert_array_equal(forces[0], ct.wrench("exact", (1, 0, 100), 1.7, PATCH))


@pytest.mark.parametrize("step", [1, 2])
def test_results_go_into_arrays_of_any_order(step):
    motions = np.random.default_rng(5).normal(size=(4, 3))
    value, slopes = ct.wrench("exact", motions, 1, PATCH, slopes=True)
    out = np.zeros((4, 3 * step))[:, ::step], np.zeros((3, 3, 4)).T
    assert ct.wrench("exact", motions, 1, PATCH, slopes=True, out=out) == out
    np.testing.assert_array_equal(out[0], value)
    np.testing.assert_array_equal(out[1], slopes)
    ct.wrench("exact", motions, 1, PATCH, out=motions)  # the motions themselves
    np.testing.assert_array_equal(motions, value)
    k = U.copy()
    force, moment = ct.law("exact")(k)
    ct.law("exact")(k, out=(k, out[0][0]))
    np.testing.assert_array_equal([k, out[0][0]], [force, moment])
    with pytest.raises(ValueError, match="^out: 2 arrays are needed, got 1"):
        ct.law("exact")(k, out=np.empty(3))


def test_loads_that_begin_where_the_forces_do():
    room = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])
    wanted = ct.wrench("exact", (1, 0, 100), room[:3].copy(), PATCH)
    np.testing.assert_array_equal(ct.wrench("exact", (1, 0, 100), room[:3], PATCH, out=room.reshape(3, 3)), wanted)


@pytest.mark.parametrize("text", [np.array(["1", "2"], object), np.array([1.0, b"2"], object)])
@each_function
def test_objects_that_are_text_are_refused(function, text):
    with pytest.raises(TypeError, match="real numbers are needed|unsupported operand"):
        function(text)


def test_a_law_has_no_value_where_k_has_none():
    force, moment = ct.law("exact")([0.5, np.nan])
    assert np.isnan(force).tolist() == np.isnan(moment).tolist() == [False, True] and np.isnan(ct.law("exact")(np.nan)).all()


class Labelled:
    """An array with a label, which lets the function work on the numbers, as such arrays do."""

    def __init__(self, numbers, label):
        self.numbers, self.label = np.asarray(numbers), label

    def __truediv__(self, other):
        return Labelled(self.numbers / other, self.label)

    def __array_ufunc__(self, function, method, *given, **more):
        if method != "__call__":
            return NotImplemented
        results = function(*(each.numbers if isinstance(each, Labelled) else each for each in given), **more)
        return tuple(Labelled(each, self.label) for each in results) if function.nout > 1 else Labelled(results, self.label)


class Refusing:
    __array_ufunc__ = None

    def __truediv__(self, other):
        return self


class Metres(Refusing):
    unit = "m"


@each_function
def test_an_array_decides_what_comes_back(function):
    for result, plain in zip(function(Labelled(U, "mine")), function(U), strict=True):
        assert isinstance(result, Labelled) and result.label == "mine"
        np.testing.assert_array_equal(result.numbers, plain)
    with pytest.raises(TypeError, match="these arrays do not go together: .*Refusing"):
        function(Refusing())
    for metres in (Metres(), [1, Metres()]):
        if not (isinstance(metres, list) and function is FUNCTIONS["mu"]):
            with pytest.raises(TypeError, match="numbers without a unit are needed; got a Metres of unit 'm': pass its value"):
                function(metres)


def test_gradients_go_with_their_array():
    tau, by = ct.stop_time(u=Labelled(U, "mine"), v=1, mu=0.3, gradient=True)
    plain, slopes = ct.stop_time(u=U, v=1, mu=0.3, gradient=True)
    np.testing.assert_array_equal(tau.numbers, plain)
    np.testing.assert_array_equal(by["mu"].numbers, slopes["mu"])
    part, by = ct.stop_time(u=U, v=1, mu=[0.3, 0.2, 0.3], gradient=True, where=[True, False, True])
    assert np.isnan(part[1]) and np.isnan(by["v"][1]) and by["v"][0] == slopes["v"][0]
