"""What is given as numbers: masks, dates, text, threads, arrays to write into; and Ctrl-C."""

import os
import signal
import subprocess
import sys
import time

import contensou as ct
import numpy as np
import pytest

FLOW = ct.Flow(mu=0.3)


def test_what_is_masked_is_not_a_number():
    u = np.ma.array([1.0, 2.0, 3.0], mask=[False, True, False])
    taus = FLOW.stop_time(u=u, v=1)
    assert np.isnan(taus).tolist() == [False, True, False]
    assert taus[2] == FLOW.stop_time(u=3, v=1)
    assert np.isnan(ct.stop_time(u=u, v=1, mu=[0.1, 0.1, 0.2])).tolist() == [False, True, False]
    with pytest.raises(ValueError, match="tau must be >= 0, got nan"):
        FLOW.orbit(u=1, v=1).at(np.ma.array([0.5, 1], mask=[0, 1]))
    ball, t = ct.Ball.pool(), np.linspace(0, 1, 40)
    spin = ball.roll(slip=0, spin=50)(t)["wz"]
    wrong = spin.copy()
    wrong[3] = 1e3
    masked = np.ma.array(wrong, mask=wrong == 1e3)
    free = ("friction", "spin")
    assert ct.fit(t, spin=masked, ball=ball, sd={"spin": 0.1}, free=free).friction == \
        ct.fit(t, spin=np.where(wrong == 1e3, np.nan, spin), ball=ball, sd={"spin": 0.1}, free=free).friction


@pytest.mark.parametrize("given, kind", [
    (np.array(["2020-01-01"], "datetime64[D]"), r"datetime64\[D\]"), (np.array([3], "timedelta64[s]"), r"timedelta64\[s\]"),
    (["1"], "<U1"), ("1", "<U1"), (np.array([b"1"]), "S1"), ([1 + 2j], "complex128"), ([{}], "not 'dict'")])
@pytest.mark.parametrize("name, ask", [
    ("u", lambda given: FLOW.stop_time(u=given, v=1)), ("tau", lambda given: FLOW.orbit(u=1, v=1).at(given)),
    ("t", lambda given: ct.Ball.pool().roll()(given)), ("k", lambda given: ct.law("exact")(given)),
    ("mu", lambda given: ct.stop_time(u=1, v=1, mu=given)),
    ("spin", lambda given: ct.fit([0.0], spin=given, ball=ct.Ball.pool()))])
def test_what_is_no_real_number_is_refused(name, ask, given, kind):
    with pytest.raises(TypeError, match=f"^{name}: real numbers are needed.*{kind}"):
        ask(given)


@pytest.mark.parametrize("threads, error, words", [
    (-1, ValueError, "threads: a thread or more is needed, at most 1024; got -1"),
    (2.5, TypeError, "threads: a whole number is needed, got 2.5"), (2**70, ValueError, f"got {2**70}")])
def test_threads_are_counted(threads, error, words):
    for ask in (FLOW.stop_time, lambda **given: ct.stop_time(mu=[0.3], **given)):
        with pytest.raises(error, match=words):
            ask(u=[1.0], v=[1.0], threads=threads)


def test_an_array_to_write_into():
    for ask in (FLOW.stop_time, lambda **given: ct.stop_time(mu=[0.3, 0.2], **given)):
        with pytest.raises(TypeError, match=r"out: an array of NumPy is needed, float64 of shape \(2,\), got list"):
            ask(u=[1.0, 2.0], v=1, out=[0.0, 0.0])
        with pytest.raises(ValueError, match=r"out: float64 of shape \(2,\) is needed, got float32 of shape \(3,\)"):
            ask(u=[1.0, 2.0], v=1, out=np.zeros(3, np.float32))


def test_more_numbers_than_fit_the_memory():
    with pytest.raises(MemoryError, match="TiB"):
        FLOW.orbit(u=1, v=1).at(np.broadcast_to(1.0, (10**13,)))


def test_the_version():
    assert ct.__version__.count(".") == 2


@pytest.mark.parametrize("call", [
    "ct.Flow(mu=0.3).orbit(u=1, v=1).at(np.broadcast_to(1.0, 20_000_000))",
    "ct.Ball.pool().roll()(np.broadcast_to(1.0, 20_000_000))",
    "ct.fit(t, slip=at, spin=9 - t, x=t, y=at, ball=ct.Ball.pool())"])
def test_ctrl_c_ends_a_long_call(call):
    code = f"""import contensou as ct, numpy as np
t = np.linspace(0, 9, 2_000_000)
at = np.exp(-t)
print('ready', flush=True)
{call}"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=os.environ) as process:
        assert process.stdout.readline() == b"ready\n"
        time.sleep(1)  # within the call, which takes many
        process.send_signal(signal.SIGINT)
        sent = time.monotonic()
        _, error = process.communicate()
        print(f"{call}: ended {time.monotonic() - sent:.2f} s after Ctrl-C")
        assert b"KeyboardInterrupt" in error
