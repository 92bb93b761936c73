"""Derives the coefficients of contensou/wrench_kernel.h from the laws, and bounds their error.

    python3 wrench_kernel.py            prints the coefficients and the largest errors
    python3 wrench_kernel.py HEADER     ends with 1 if HEADER has other coefficients, or if an error is too large

The functions are g = Phi/k, h = Psi, c = Phi' for k = v/(radius |w|) <= 1, and g = Phi, h = k Psi, c = k^3 Phi' for k >= 1.
They are 2F1 of z = min(k, 1/k)^2 (reduction/laws/laws.cpp, laws.hpp). With y = 1 - z, contiguous 2F1 give

    exact    k >= 1: h = (g - y c)/4. For k < 1 all three are polynomials.
    uniform  k >= 1: h = (g - y c)/3. For k < 1, with g and c of 1/k: g, ((1 + y) g - z y c)/3, g - z c.

Two functions of each pressure are enough: g and c, or g and h. Their singular points are y = 0, at which k = 1, and z = infinity.

    exact    g and c are analytic in q = sqrt(y) except on q <= -1. A Moebius map takes the points 0, 1, -1, infinity of q
             to -x1, x1, -1, 1. Interpolation in Chebyshev points between -x1 and x1 then converges like (x1/2)^n.
    uniform  y >= 0.5: g and h as above, with y in place of q and 0.5, 1, 0, infinity.
             y < 0.5: g = P + y^2 log(y) Q and c = P + y log(y) Q, interpolated in the squares of Chebyshev points. They
             are dense at y = 0, as the logarithm needs. P and Q for all y would be large and cancel each other at y = 1.
"""
import pathlib
import sys

import mpmath as mp

mp.mp.dps = 60
half = mp.mpf(1) / 2
ALLOWED = {"g": 1e-16, "h": 1e-16, "c": 4e-16}  # relative errors; c is for slopes alone where it is (g - 3 h)/y
SEAM = mp.mpf("0.5")


def chebyshev(count):
    return [-mp.cos(mp.pi * (i + half) / count) for i in range(count)]


def interpolate(points, basis, function):
    """The coefficients of the basis, as doubles, with which the sum equals the function at the points."""
    rows = mp.matrix([basis(point) for point in points])
    return [float(c) for c in mp.lu_solve(rows, mp.matrix([function(point) for point in points]))]


def powers(x, count):
    return [x**n for n in range(count)]


def between(shift, scale, function, count):
    """A polynomial in x = (s - shift)/(s + scale), -x1 <= x <= x1, where s = 1 at x1."""
    def s_of(x):
        return (shift + x * scale) / (1 - x)

    points = [(1 - shift) / (1 + scale) * point for point in chebyshev(count)]
    found = interpolate(points, lambda x: powers(x, count), lambda x: function(s_of(x)))
    return [found], lambda s: mp.fdot(found, powers((s - shift) / (s + scale), count))


def beside_0(power, function, count, more):
    """P + y^power log(y) Q, up to y = SEAM."""
    def basis(y):
        times = mp.log(y) * y**power if y else 0
        return powers(y, count) + [times * each for each in powers(y, more)]

    points = [SEAM * ((1 + point) / 2)**2 for point in chebyshev(count + more)]
    found = interpolate(points, basis, function)
    return [found[:count], found[count:]], lambda y: mp.fdot(found, basis(y))


def F(a, b, c, times=mp.mpf(1)):
    return lambda y: times * mp.hyp2f1(a, b, c, 1 - y)


exact_g, exact_h, exact_c = F(-half, half, 5 * half), F(half, half, 7 * half, half / 2.5), F(half, 3 * half, 7 * half, half / 2.5)
disc_g, disc_h, disc_c = F(-half, half, 2), F(half, half, 3, half / 2), F(half, 3 * half, 3, half / 2)
inner_h = F(half, -3 * half, 1, 2 / mp.mpf(3))  # uniform, k < 1
# c is a derivative of g: Phi' = -2 k^-3 dg/dz for k >= 1, and g + 2 z dg/dz for k < 1.
assert all(abs(2 * mp.diff(g, half) - c(half)) < 1e-25 for g, c in ((exact_g, exact_c), (disc_g, disc_c)))

root2, root = mp.sqrt(2), mp.sqrt(SEAM)
tables = {
    "exact, g": between(root2 - 1, root2 + 1, lambda q: exact_g(q * q), 16),
    "exact, c": between(root2 - 1, root2 + 1, lambda q: exact_c(q * q), 20),
    "uniform, y >= 0.5, g": between(root, root, disc_g, 16),
    "uniform, y >= 0.5, h": between(root, root, disc_h, 16),
    "uniform, y < 0.5, g": beside_0(2, disc_g, 12, 8),
    "uniform, y < 0.5, c": beside_0(1, disc_c, 12, 12),
}
errors = {}
for i in range(41):
    for y in {mp.mpf(i) / 40, mp.mpf(10)**(-i / mp.mpf(2))}:
        z, side = 1 - y, "uniform, y >= 0.5, " if y >= SEAM else "uniform, y < 0.5, "
        g, c = tables["exact, g"][1](mp.sqrt(y)), tables["exact, c"][1](mp.sqrt(y))
        G = tables[side + "g"][1](y)
        C = tables[side + "c"][1](y) if y < SEAM else (G - 3 * tables[side + "h"][1](y)) / y
        for name, value, law in (
                ("exact, g", g, exact_g(y)), ("exact, h", (g - y * c) / 4, exact_h(y)), ("exact, c", c, exact_c(y)),
                (side + "g", G, disc_g(y)), (side + "h", (G - y * C) / 3, disc_h(y)), (side + "c", C, disc_c(y)),
                (side + "k < 1, h", ((1 + y) * G - z * y * C) / 3, inner_h(y)),
                (side + "k < 1, c", G - z * C, disc_g(y) - z * disc_c(y))):
            errors[name] = max(errors.get(name, 0), abs(value / law - 1))

failed = [f"{name}: the error is too large" for name, error in errors.items() if error > ALLOWED[name.split(", ")[-1][0]]]
header = "".join(pathlib.Path(sys.argv[1]).read_text().split()) if len(sys.argv) > 1 else None
for name, (parts, _) in tables.items():
    for part in parts:
        text = ", ".join(map(repr, part))
        print(f"// {name}\n{text}")
        if header is not None and text.replace(" ", "") not in header:
            failed.append(f"{name}: {sys.argv[1]} has other coefficients")
for name, error in errors.items():
    print(f"{name}: relative error {mp.nstr(error, 2)}")
print(f"q - {mp.nstr(root2 - 1, 20)}, q + {mp.nstr(root2 + 1, 20)}; y -+ {mp.nstr(root, 20)}")
sys.exit("\n".join(failed) or None)
