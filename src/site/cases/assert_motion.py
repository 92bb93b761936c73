# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The contensou authors
"""Compare the motion of a physics engine with a reference motion of this folder. This file needs NumPy alone."""

import csv as tables
import pathlib

import numpy as np


def scales(csv):
    """Return the tolerance of a case and the scales of v (m/s), w_xy and w_z (rad/s), from tolerances.csv beside it."""
    csv = pathlib.Path(csv)
    with open(csv.with_name("tolerances.csv"), newline="") as file:
        for row in tables.DictReader(file):
            if row["case"] == csv.stem:
                return float(row["tol"]), {name: float(row[name]) for name in ("v", "w_xy", "w_z")}
    raise ValueError(f"tolerances.csv: no row for {csv.stem}; add one, or use a case that it contains")


def assert_motion(csv, t, v, w, tol=None):
    """Raise AssertionError if a motion differs from the reference.

    csv  reference motion, such as "puck.csv"; tolerances.csv must be beside it
    t    n times in s, increasing, between the first and the last time of the csv
    v    velocity of the centre in m/s, n x 2 (x, y)
    w    angular velocity in rad/s, n x 3, z up
    tol  largest difference that passes, as a share of the scales in tolerances.csv; by default its column tol

    The reference is linear between two rows. Its error is at most 0.0002 of the scales.
    Wrong arguments raise ValueError.
    """
    table = np.loadtxt(csv, delimiter=",", skiprows=1)
    t, v, w = (np.asarray(a, dtype=float) for a in (t, v, w))
    if t.ndim != 1 or len(t) == 0:
        raise ValueError(f"t: shape {t.shape}; one or more times in one dimension are needed")
    for name, array, width in (("t", t, None), ("v", v, 2), ("w", w, 3)):
        if width and array.shape != (len(t), width):
            raise ValueError(f"{name}: shape {array.shape}; ({len(t)}, {width}) is needed, a row for each time")
        if not np.isfinite(array).all():
            raise ValueError(f"{name}: row {np.argwhere(~np.isfinite(array))[0][0]} is not finite")
    if (np.diff(t) <= 0).any():
        i = int(np.argmax(np.diff(t) <= 0))
        raise ValueError(f"t: {t[i + 1]:.9g} s comes after {t[i]:.9g} s; the times must increase")
    first, last = table[[0, -1], 0]
    if t[0] < first or t[-1] > last:
        outside = t[0] if t[0] < first else t[-1]
        raise ValueError(f"t: {outside:.9g} s is outside {pathlib.Path(csv).name}, which has {first:g} to {last:g} s")
    usual, scale = scales(csv)
    tol = usual if tol is None else tol
    if not 0 < tol < np.inf:
        raise ValueError(f"tol: {tol}; a share above 0 is needed, such as 0.01")
    wanted = np.column_stack([np.interp(t, table[:, 0], column) for column in table.T[3:]])
    names, units = ("vx", "vy", "wx", "wy", "wz"), ("m/s", "m/s", "rad/s", "rad/s", "rad/s")
    allowed = tol * np.array([scale[name] for name in ("v", "v", "w_xy", "w_xy", "w_z")])
    given = np.column_stack([v, w])
    off = np.abs(given - wanted)
    i, j = np.unravel_index(np.argmax(off / allowed), off.shape)
    if off[i, j] > allowed[j]:
        raise AssertionError(
            f"{pathlib.Path(csv).name}: at t = {t[i]:.6g} s {names[j]} is {given[i, j]:.6g} {units[j]} and should be "
            f"{wanted[i, j]:.6g}; the difference {off[i, j]:.3g} is above the tolerance {allowed[j]:.3g} {units[j]}")
