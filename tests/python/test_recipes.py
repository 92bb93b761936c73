"""The recipes of the README for JAX and PyTorch: run as they stand there, by the frameworks where they are installed, else
by stand-ins of NumPy that do what the recipes ask of them."""

import re
import sys
import types
from pathlib import Path

import contensou as ct
import numpy as np
import pytest

README = Path(__file__).parents[2] / "src/python/README.md"


def recipe(framework):
    """The block of the README that imports it."""
    blocks = re.findall(r"```python\n(.*?)```", README.read_text(), re.S)
    found, = [block for block in blocks if f"import {framework}" in block and ">>>" not in block]
    return found


class _CustomVjp:
    """jax.custom_vjp, as far as one call and its pullback go."""

    def __init__(self, function):
        self.function = function

    def defvjp(self, forward, backward):
        self.forward, self.backward = forward, backward

    def __call__(self, *given):
        return self.function(*given)


def stand_in_for_jax():
    numpy = types.ModuleType("jax.numpy")
    for name in ("asarray", "broadcast_arrays", "shape", "float64"):
        setattr(numpy, name, getattr(np, name))
    jax = types.ModuleType("jax")
    jax.numpy, jax.custom_vjp = numpy, _CustomVjp
    jax.ShapeDtypeStruct = lambda shape, dtype: (shape, dtype)

    def pure_callback(function, like, *given):
        results = function(*given)
        for result, (shape, dtype) in zip(results, like, strict=True):
            assert result.shape == shape and result.dtype == dtype
        return results

    jax.pure_callback = pure_callback
    jax.config = types.SimpleNamespace(update=lambda name, value: None)
    return {"jax": jax, "jax.numpy": numpy}


class _Tensor(np.ndarray):
    device = "cpu"

    def detach(self):
        return self

    cpu = detach

    def numpy(self):
        return np.asarray(self)


def stand_in_for_torch():
    torch = types.ModuleType("torch")

    class Function:
        @classmethod
        def apply(cls, *given):
            context = types.SimpleNamespace()
            context.save_for_backward = lambda *tensors: setattr(context, "saved_tensors", tensors)
            result = cls.forward(context, *given)
            result.context = context
            return result

    torch.autograd = types.SimpleNamespace(Function=Function)
    torch.as_tensor = lambda values, dtype=None, device=None: np.array(values, dtype=dtype).view(_Tensor)
    torch.broadcast_tensors = lambda *given: [np.array(each).view(_Tensor) for each in np.broadcast_arrays(*given)]
    return {"torch": torch}


def run(framework, stand_in, monkeypatch):
    try:
        __import__(framework)
        real = True
    except ImportError:
        real = False
        for name, module in stand_in().items():
            monkeypatch.setitem(sys.modules, name, module)
    scope = {}
    exec(recipe(framework), scope)
    return scope, real


U, V, MU = np.array([1.0, 0.4, 2.0, -0.7]), np.array([1.0, 1.5, 0.2, 0.9]), np.array([0.3, 0.3, 0.1, 0.8])
WEIGHTS = np.array([1.0, -2.0, 0.5, 3.0])


def by_differences():
    """The derivatives of the weighted sum."""
    slopes = []
    for i in range(3):
        step = np.zeros((3, U.size))
        step[i] = 1e-5
        ends = [ct.stop_time(u=U + way * step[0], v=V + way * step[1], mu=MU + way * step[2]) for way in (1, -1)]
        slopes.append(WEIGHTS * (ends[0] - ends[1]) / 2e-5)
    return slopes


def test_jax(monkeypatch):
    scope, real = run("jax", stand_in_for_jax, monkeypatch)
    stop_time = scope["stop_time"]
    if real:
        import jax

        value, pull = jax.vjp(stop_time, U, V, MU)
        slopes = pull(jax.numpy.asarray(WEIGHTS))
    else:
        value, saved = scope["_stop_time"].forward(U, V, MU)
        slopes = scope["_stop_time"].backward(saved, WEIGHTS)
        np.testing.assert_array_equal(stop_time(U, V, MU), value)
    np.testing.assert_allclose(value, ct.stop_time(u=U, v=V, mu=MU), rtol=1e-14)
    np.testing.assert_allclose(slopes, by_differences(), rtol=1e-7)


def test_torch(monkeypatch):
    scope, real = run("torch", stand_in_for_torch, monkeypatch)
    if real:
        import torch

        given = [torch.tensor(each, requires_grad=True) for each in (U, V, MU)]
        value = scope["stop_time"](*given)
        value.backward(torch.tensor(WEIGHTS))
        slopes, value = [each.grad.numpy() for each in given], value.detach().numpy()
    else:
        value = scope["stop_time"](U, V, MU)
        slopes = scope["StopTime"].backward(value.context, WEIGHTS)
    np.testing.assert_allclose(value, ct.stop_time(u=U, v=V, mu=MU), rtol=1e-14)
    np.testing.assert_allclose(slopes, by_differences(), rtol=1e-7)


@pytest.mark.parametrize("framework", ["jax", "torch"])
def test_each_recipe_is_there(framework):
    assert "ct.stop_time(" in recipe(framework) and "gradient=True" in recipe(framework)
