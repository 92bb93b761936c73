"""Test a copy of the folder of reference motions with a stepper that includes the wrench in one header alone.

    reference_motions.py TOP C++COMPILER
"""

import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)

TOP, COMPILER = pathlib.Path(sys.argv[1]), sys.argv[2]
WORK = pathlib.Path(tempfile.mkdtemp())
CASES = WORK / "cases"
NOT_BY_OTHERS = {"ball-slides", "ball-spins", "puck-slides"}  # slip or spin alone: the elliptic cone is exact


def refused(error, words, *arguments):
    try:
        assert_motion(*arguments)
    except error as complaint:
        assert re.search(words, str(complaint)), (words, str(complaint))
        return str(complaint)
    raise SystemExit(f"{words}: not refused")


def scales_of(case):
    """Return the scales of v, w_xy and w_z from the first row, with the units of `contensou check --against`."""
    text = (CASES / f"{case}.toml").read_text()
    radius, ball = float(re.search(r"^radius = (\S+)", text, re.M)[1]), "body = 'ball'" in text
    vx, vy, wx, wy, wz = np.loadtxt(CASES / f"{case}.csv", delimiter=",", skiprows=1)[0, 3:]
    slip, spin = np.hypot(vx - ball * radius * wy, vy + ball * radius * wx), abs(wz)
    slip, spin = slip or radius * spin, spin or slip / radius
    return [2 / 7 * slip, 5 / 7 * slip / radius, spin] if ball else [slip, slip / radius, spin]


try:
    shutil.copytree(TOP / "src/site/cases", CASES, ignore=shutil.ignore_patterns("__pycache__"))
    (WORK / "contensou").mkdir()
    shutil.copy(TOP / "reduction/include/contensou/wrench_kernel.h", WORK / "contensou")
    subprocess.run([COMPILER, "-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic", "-MMD", "-MF", "headers",
                    "-I", WORK, TOP / "tests/consumer/stepper.cpp", "-o", "stepper"], cwd=WORK, check=True)
    headers = re.findall(r"[\w+]+\.(?:h|hpp)\b|Eigen", (WORK / "headers").read_text())
    assert headers == ["wrench_kernel.h"], headers

    sys.path.insert(0, str(WORK))
    sys.dont_write_bytecode = True
    from cases.assert_motion import assert_motion

    def stepped(case, *law):
        global told
        last = (CASES / f"{case}.csv").read_text().split("\n")[-2].split(",")[0]
        out = subprocess.run([WORK / "stepper", CASES / f"{case}.toml", last, *law], check=True, capture_output=True)
        told = out.stderr.decode()
        (WORK / "log.csv").write_bytes(out.stdout)
        log = np.loadtxt(WORK / "log.csv", delimiter=",", skiprows=1)
        assert len(log) > 9
        return CASES / f"{case}.csv", log[:, 0], log[:, 1:3], log[:, 3:]

    cases = sorted(path.stem for path in CASES.glob("*.toml"))
    with open(CASES / "tolerances.csv") as file:
        table = {row.pop("case"): [float(number) for number in row.values()] for row in csv.DictReader(file)}
    assert len(cases) == 10 and sorted(table) == cases
    for case in cases:
        np.testing.assert_allclose(table[case], [0.01, *scales_of(case)], rtol=1e-5)
        motion = stepped(case)
        assert_motion(*motion)
        assert_motion(*motion, 0.0005)  # of steps and interpolation together
        if case in NOT_BY_OTHERS:
            print(case)
        else:
            print(refused(AssertionError, rf"^{case}\.csv: at t = [\d.]+ s [vw][xyz] is .* difference .* tolerance",
                          *stepped(case, "elliptic")))

    # Implicit steps: their errors in % of the scales, and the calls of the law. The page on engines has the table.
    def largest_error(path, t, v, w):
        """Return the largest error as a share of the scales, by bisection over the tolerance of assert_motion."""
        low, high = 0, 1
        while high - low > 1e-5:
            try:
                assert_motion(path, t, v, w, (low + high) / 2)
                high = (low + high) / 2
            except AssertionError:
                low = (low + high) / 2
        return high

    page = (TOP / "src/si/README.md").read_text()
    for case in cases:
        row = f"| {case} |"
        for rate, allowed in (("60", 0.025), ("240", 0.01)):
            error = largest_error(*stepped(case, rate))
            mean, most = told.split()
            assert error <= allowed and float(mean) <= 6, (case, rate, error, told)
            row += f" {100 * error:.2f} | {mean} | {most} |"
        print(row)
        assert row in page, row

    # The example of the README, beside the folder, with a log that passes and one that fails as the README shows.
    readme = (CASES / "README.md").read_text()
    example, shown = (re.search(rf"^```{kind}\n(.*?)^```", readme, re.S | re.M)[1] for kind in ("python", "text"))
    for law in ([], ["elliptic"]):
        stepped("puck", *law)
        run = subprocess.run([sys.executable, "-c", example], cwd=WORK, capture_output=True, text=True)
        last = "".join(run.stderr.splitlines(keepends=True)[-1:])
        without_numbers = [re.sub(r"\d+(\.\d+)?", "#", text) for text in (last, shown if law else "")]
        assert without_numbers[0] == without_numbers[1], run.stderr
    motion = stepped("puck")

    # One number at a time, just inside and just outside; the quantity is named.
    path, t, v, w = motion
    for place, name, scale in ((0, "vx", 5), (1, "vy", 5), (2, "wx", 131.234), (3, "wy", 131.234), (4, "wz", 100)):
        for share in (0.0095, 0.0105):
            both = np.column_stack([v, w])
            both[700, place] += share * scale
            if share < 0.01:
                assert_motion(path, t, both[:, :2], both[:, 2:])
            else:
                refused(AssertionError, f"at t = 3.5 s {name} is", path, t, both[:, :2], both[:, 2:])

    nan, late, back = np.array(v), t + 1, np.array(t)
    nan[5, 1], back[7] = np.nan, back[6]
    refused(ValueError, r"^t: .* is outside puck.csv, which has 0 to 6\.893 s", path, late, v, w)
    refused(ValueError, r"^t: -1 s is outside", path, t - 1, v, w)
    refused(ValueError, "must increase", path, back, v, w)
    refused(ValueError, "v: row 5 is not finite", path, t, nan, w)
    refused(ValueError, "t: row 0 is not finite", path, t * np.nan, v, w)
    refused(ValueError, "w: row 0 is not finite", path, t, v, w + np.inf)
    refused(ValueError, "v: shape", path, t, v[:-1], w)
    refused(ValueError, "w: shape", path, t, v, w[:, 2])
    refused(ValueError, "t: shape", path, [], v, w)
    refused(ValueError, "tol: 0", path, t, v, w, 0)
    refused(ValueError, "tol: nan", path, t, v, w, float("nan"))
    shutil.copy(path, CASES / "mine.csv")
    refused(ValueError, "no row for mine", CASES / "mine.csv", t, v, w)
finally:
    shutil.rmtree(WORK)
