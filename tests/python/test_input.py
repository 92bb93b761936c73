"""What is given as numbers: masks, dates, text, threads, arrays to write into; and Ctrl-C."""

import os
import pathlib
import re
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


def processor_ticks(pid):
    """Returns the processor time of a process, in ticks of the system."""
    return sum(map(int, pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[11:13]))


@pytest.mark.parametrize("call", [
    "ct.Flow(mu=0.3).orbit(u=1, v=1).at(np.broadcast_to(1.0, 20_000_000))",
    "ct.Ball.pool().roll()(np.broadcast_to(1.0, 20_000_000))",
    "ct.fit(t, slip=at, spin=9 - t, x=t, y=at, ball=ct.Ball.pool())"])
def test_ctrl_c_ends_a_long_call(call):
    code = f"""import contensou as ct, numpy as np
t = np.linspace(0, 9, 2_000_000)
at = np.exp(-t)
print('ready', flush=True)
while True: {call}"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=os.environ) as process:
        assert process.stdout.readline() == b"ready\n"
        # Until it works, which it does within the call, whatever the machine is as fast as.
        begun = processor_ticks(process.pid)
        while process.poll() is None and processor_ticks(process.pid) < begun + 5:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate()
        assert b"KeyboardInterrupt" in error


def test_signals_are_heard_during_the_samples_of_an_uncertainty():
    heard = []
    before = signal.signal(signal.SIGALRM, lambda *_: heard.append(1))
    signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
    try:
        # This motion is integrated in 1000 samples. Without a look for signals they are heard once, after the call.
        ct.Ball.pool().but(slope=1, rolling_friction=0.01).roll(velocity=(1, 0.3), angular_velocity=(10, 20, 30)).uncertainty(friction=0.01)
        during = len(heard)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert during >= 2


@pytest.mark.skipif(sys.version_info >= (3, 13), reason="the name of the module has changed")
def test_a_sub_interpreter_is_refused():
    code = """import _xxsubinterpreters as interpreters
one = interpreters.create()
interpreters.run_string(one, "import contensou")"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600, env=os.environ)
    assert "only in the main interpreter" in done.stderr


POOL, PUCK, T = ct.Ball.pool(), ct.Ball.puck(), np.linspace(0, 0.5, 20)
FILM = {"slip": np.exp(-T), "ball": POOL}


def refused(ask, error, words):
    """What is not meant for users is in no message: signatures and names of C++, options of the program."""
    with pytest.raises(error, match=words) as told:
        ask()
    assert not re.search("incompatible|C\\+\\+|::|core|--|NoneType|attribute", str(told.value))


@pytest.mark.parametrize("words, ask", [
    ("^u: numbers up to 1.8e\\+308 are allowed", lambda: ct.stop_time(u=10**400, v=1, mu=0.1)),
    ("^u: rows of one length are needed; got \\[\\[1\\], \\[2, 3\\]\\]", lambda: FLOW.stop_time(u=[[1], [2, 3]], v=1)),
    ("^shapes that broadcast are needed; got u of \\(2,\\), v of \\(3,\\)", lambda: FLOW.stop_time(u=[1, 2], v=[1, 2, 3])),
    ("^sd of slip: a number, or one for each time, shape \\(20,\\), is needed; got shape \\(2,\\)", lambda: ct.fit(T, **FILM, sd={"slip": [1, 2]})),
    ("^t must increase; 0.47.* follows 0.5", lambda: ct.fit(T[::-1], **FILM)),
    ("^rolling_below: 0 or more is needed, in m/s; got -1", lambda: POOL.roll(rolling_below=-1)),
    ("^t must be >= 0, in s; got -1", lambda: POOL.roll(slip=1)(-1)),
    ("^row 0: t must be >= 0, in s; got -1", lambda: POOL.roll(slip=[1])(-1)),
    ("^tau must be >= 0", lambda: FLOW.orbit(u=1, v=1).at(-1)),
    ("^u and v must be finite", lambda: FLOW.orbit(u=1, v=-1)),
    ("^count: one instant or more", lambda: FLOW.orbit(u=1, v=1).sample(0)),
    ("^the ratio k .* must be >= 0", lambda: ct.law("exact")(-1)),
    ("^two or more rows are needed", lambda: ct.law(rho=[0], pressure=[1])),
    ("^u = v = 0 is rest", lambda: ct.check(u=0, v=0, mu=0.1)),
    ("'c' is no variable, parameter or function: give its value as c=VALUE, at character 7", lambda: ct.law("phi = c; psi = k")),
    ("mu is 1: leave mu out", lambda: ct.Flow(mu=0.5, body="disc")),
    ("rolling_friction=0 leaves it out", lambda: ct.aim(POOL.but(rolling_friction=0.01), rolls_at=0.1, rolling_speed=1)),
    ("^tip, cue_mass of a stroke, which there is none: give strike", lambda: POOL.roll(tip=(0.1, 0.1), cue_mass=0.5)),
    ("^elevation of a stroke", lambda: POOL.roll(elevation=[3, 4], slip=1)),
    ("^strike is a start of its own: leave out slip", lambda: POOL.roll(strike=1, slip=1)),
    ("a disc lies flat .* a cue strikes balls: give slip and spin", lambda: PUCK.roll(strike=2, tip=(0.3, 0))),
    ("^row 0: a disc lies flat", lambda: PUCK.roll(strike=[2, 3])),
    ("^rolling_below: a disc lies flat and never rolls: leave it out", lambda: PUCK.roll(rolling_below=0.1)),
    ("^name: one line of text without control characters is needed; got 'a.nb'", lambda: POOL.but(name="a\nb")),
    ("no such engine 'isac' \\(did you mean 'isaac'", lambda: ct.engine("isac", POOL))])
def test_what_is_out_of_range_is_told_by_its_name(ask, words):
    refused(ask, ValueError, words)


@pytest.mark.parametrize("name, ask", [
    ("u", lambda: ct.stop_time(u=None, v=1, mu=0.1)), ("u", lambda: FLOW.orbit(u=None, v=1)),
    ("law", lambda: ct.law(3)), ("law", lambda: ct.stop_time(u=1, v=1, mu=0.1, law=["exact"])), ("law", lambda: POOL.but(law=3)),
    ("law", lambda: POOL.roll(law=3)), ("law", lambda: ct.fit(T, **FILM, law=["exact", "pade"])),
    ("c", lambda: ct.law("phi = k/(c + k); psi = 1/(c + k)", c="x")), ("kinks", lambda: ct.law(max, kinks="a")),
    ("name", lambda: ct.law(max, name=3)), ("body", lambda: ct.Flow(mu=0.3, body=3)),
    ("body", lambda: ct.stop_time(u=1, v=1, mu=0.3, body=(1, 2, 3))), ("body", lambda: POOL.but(body=3)),
    ("name", lambda: POOL.but(name=3)), ("name", lambda: ct.Ball.named(3)), ("name", lambda: ct.engine(3, POOL)),
    ("ball", lambda: ct.engine("mujoco", 3)), ("ball", lambda: ct.engines("pool")), ("ball", lambda: ct.aim("pool", distance=1, time=1)),
    ("ball", lambda: ct.fit(T, slip=T, ball="pool")), ("ball", lambda: ct.fit_plan(T, ball="pool", sd={"slip": 1})),
    ("ball", lambda: ct.portrait(ball=3)), ("system", lambda: ct.reduce(3, u=1, v=1)),
    ("a", lambda: ct.reduce("u' = -a*u; v' = -v", u=1, v=1, a="x")), ("robust", lambda: ct.fit(T, **FILM, robust="yes")),
    ("sd", lambda: ct.fit(T, **FILM, sd=0.1)), ("sd", lambda: ct.fit_plan(T, ball=POOL, sd=0.1)),
    ("free", lambda: ct.fit(T, **FILM, free=3)), ("load", lambda: POOL.roll(load=3)), ("load", lambda: POOL.roll(load=([0], [1], 3))),
    ("slip", lambda: POOL.roll(slip=1).uncertainty(slip=None)), ("uncertainty", lambda: POOL.roll(slip=1).uncertainty(3)),
    ("count", lambda: FLOW.orbit(u=1, v=1).sample("a")), ("row", lambda: POOL.roll(slip=[1])["a"]),
    ("view", lambda: ct.portrait(mu=0.3, view=3)), ("font", lambda: ct.portrait(mu=0.3, font=3)),
    ("orbits", lambda: ct.portrait(mu=0.3, orbits=2.5)), ("axes", lambda: ct.portrait(mu=0.3, axes="no")),
    ("size", lambda: ct.portrait(mu=0.3, size=("wide", 90))), ("isochrones", lambda: ct.portrait(mu=0.3, isochrones=1.5)),
    ("through", lambda: ct.portrait(mu=0.3, through=3)), ("through", lambda: ct.portrait(mu=0.3, through=[(1, 2, 3)]))])
def test_what_is_of_another_kind_is_told_by_its_name(name, ask):
    refused(ask, TypeError, f"^{name}: .* (is|are) needed")


def test_where_mu_is_masked_the_time_is_not_a_number():
    mu = np.ma.array([0.1, 0.2, 0.3], mask=[0, 1, 0])
    known, by = ct.stop_time(u=1, v=1, mu=mu, gradient=True)
    assert np.isnan(known).tolist() == np.isnan(by["mu"]).tolist() == [False, True, False]
    assert known[2] == ct.stop_time(u=1, v=1, mu=0.3)
    many = ct.stop_time(u=1, v=1, mu=np.append(np.linspace(0.1, 0.3, 1001), np.nan))
    assert np.isnan(many[-1]) and np.isfinite(many[:-1]).all()


def test_one_body_by_two_names_or_as_a_list():
    assert ct.Flow(body="puck") == ct.Flow(body="disc") and ct.Ball.puck(body="puck") == ct.Ball.puck()
    assert ct.stop_time(u=1, v=1, mu=0.3, body=[3.5, 2.5]) == ct.stop_time(u=1, v=1, mu=0.3)
    assert ct.Flow(mu=0.3, body=[3.5, 2.5]) == ct.Flow(mu=0.3, body=(3.5, 2.5))


def test_a_fault_of_ours_is_said_to_be_one():
    nothing = dict(view=None, window=None, orbits=None, through=[], isochrones=None, against=None, arrows="time", field="none",
                   axes=True, colour="time", style="print", scale="bent", estimate=False, size=(None, None), title=None)
    with pytest.raises(RuntimeError, match="^a fault of contensou, not of the input; please report it with what was asked: the call above$"):
        ct._core.Portrait([], None, None, nothing)  # no flow: the package never asks so
