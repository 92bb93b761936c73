"""The formula to type in, of reduction/numerics.md: its C, GLSL and Python against the program, over all k and mu.

    typed_formula.py PROGRAM FOLDER COMPILER
"""

import ctypes
import io
import csv
import pathlib
import subprocess
import sys
import tempfile

PROGRAM, FOLDER, COMPILER = sys.argv[1:]
TEXT = pathlib.Path(FOLDER, "numerics.md").read_text(encoding="utf-8")
ALLOWED = {"stop_time": 0.00094, "slip_length": 0.001, "slip_end": 0.00084}  # as the text says
GLSL = "#include <cmath>\nusing std::exp, std::log;\nextern \"C\" {\n%s}\n"  # the part of GLSL that is C++, too


def block(language):
    assert TEXT.count(f"```{language}\n") == 1, language
    return TEXT.split(f"```{language}\n")[1].split("```")[0]


def compiled(folder, name, source, language, number, *options):
    library = pathlib.Path(folder) / f"{name}.so"
    subprocess.run([COMPILER, "-x", language, "-shared", "-fPIC", "-O1", *options, "-", "-o", library, "-lm"],
                   input=source.encode(), check=True)
    functions = ctypes.CDLL(str(library))
    for each in ALLOWED:
        getattr(functions, each).restype = number
        getattr(functions, each).argtypes = [number, number]
    return {each: getattr(functions, each) for each in ALLOWED}


def reference(mu):
    """(k, {name: value}) of a ball with chi f g = 7/2 that slides at 1 m/s."""
    ks = [10 ** (i / 25) for i in range(-100, 126)]
    rows = "slip,spin\n" + "".join(f"1,{1 / (k * mu)!r}\n" for k in ks)
    ball = f"--ball pool --radius 1 --mass 1 --friction 1 --gravity 1 --patch-radius {mu!r} --rolling-below 0.001"
    told = subprocess.run([PROGRAM, "roll", *ball.split(), "--batch", "-"], input=rows.encode(), capture_output=True, check=True)
    for k, row in zip(ks, csv.DictReader(io.StringIO(told.stdout.decode()))):
        w = 1 / k
        yield k, {"stop_time": float(row["t_spin_ends"]) * 3.5 / w, "slip_length": float(row["slip_length"]) * 3.5 / w**2,
                  "slip_end": float(row["t_rolls"]) * 3.5 / w}


with tempfile.TemporaryDirectory() as folder:
    python = {}
    exec(block("python"), python)
    forms = {
        "C": compiled(folder, "c", block("c"), "c", ctypes.c_double, "-Wall", "-Wextra", "-Werror"),
        "GLSL": compiled(folder, "glsl", GLSL % block("glsl"), "c++", ctypes.c_float, "-fsingle-precision-constant"),
        "Python": python,
    }
    worst = {(form, name): 0.0 for form in forms for name in ALLOWED}
    for mu in (1e-4, 1e-2, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 1.0):
        for k, wanted in reference(mu):
            for form, name in worst:
                got = forms[form][name](k, 5 * mu * mu / 7)
                worst[form, name] = max(worst[form, name], abs(got / wanted[name] - 1))
    for (form, name), error in worst.items():
        print(f"{form:7} {name:12} {100 * error:.4f} %")
    assert all(error <= ALLOWED[name] * (1.005 if form == "GLSL" else 1) for (form, name), error in worst.items()), "too far off"
    assert all(error > 0.9 * ALLOWED[name] for (_, name), error in worst.items()), "the text says more than is so"
