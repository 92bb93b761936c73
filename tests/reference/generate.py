#!/usr/bin/env python3
"""Many-digit reference tables for the tests (Python 3 and mpmath, nothing else).

    python3 generate.py                     all tables, into the folder of this file
    python3 generate.py --only laws         one table (may be repeated)

Every number is computed in two independent ways, and the program stops with an error when they
agree to fewer than 30 digits.  "Zh98" is V. F. Zhuravlev, "On a model of dry friction in the
problem of rolling of rigid bodies" (1998).

Notation.  k = v/(mu |u|), w = mu |u|, v = k w, T = f g t, the paper's time tau = (3 pi/2) T, and
s = chi T.  Any law, any axisymmetric body (ball: chi = 7/2, gamma = 5/2):

    dv/ds = -Phi(k),   dw/ds = -r Psi(k),   r = gamma mu^2/chi,                          (M)

so that, with D(k) = Phi - r k Psi,

    dk/ds = -D/w,   d ln w/dk = r Psi/D.                                                 (O)

The time left is s = w sigma(k) and the regularised time is beta = h(k)/w + const; from (M), (O)

    D sigma' + r Psi sigma = 1,              sigma(0) = 1/(r Psi(0)),                    (S)
   -D h'     + r Psi h     = kappa/Q(k),     Q = (16 + 15 pi k)(8 + 3 pi k),             (B)

with kappa = 3 pi/(2 chi) (tau = kappa s) and d tau = w^2 Q d beta, the weight of Zh98 (2.8).

Way 1 of a state or stop time   Pade: closed forms (one 2F1).   Hertz: quadrature of (O).
Way 2                           both laws: Taylor series of (S), (B), (O), marched up from k = 0.
"""

import argparse
import bisect
import csv
import functools
import os
import random
import sys
import time

from mpmath import mp, mpf

PRINTED = 40            # significant digits in the tables (--digits)
GUARD = 40              # further working digits
REQUIRED = 30           # the two ways must agree to at least this many
TERMS = 140             # Taylor terms per step (way 2)
NODES = 48              # Gauss-Legendre nodes per panel (way 1, Hertz)
SEED = 1998


class Disagreement(Exception):
    """The two ways of computing a number do not agree."""


def agreed(first, second):
    """Number of digits to which two values agree (relative, at most the working precision)."""
    if first == second:
        return mp.dps
    return min(mp.dps, int(mp.floor(-mp.log10(abs(first - second) / abs(second)))))


def check(pairs, where):
    """Fewest agreed digits over pairs of values; an error if fewer than REQUIRED."""
    digits = min(agreed(first, second) for first, second in pairs)
    if digits < REQUIRED:
        raise Disagreement("%s: only %d digits agree: %s" % (where, digits, [
            (mp.nstr(first, 20), mp.nstr(second, 20)) for first, second in pairs]))
    return digits


def text(value):
    """A multiprecision number as printed in the tables."""
    return mp.nstr(value, PRINTED, strip_zeros=True, min_fixed=-3, max_fixed=20)


def double(value):
    """The double nearest to a multiprecision number."""
    return float(mp.nstr(value, 60))


def power_of_ten(exponent):
    """10^exponent rounded to a double, the same on every machine."""
    return double(mpf(10) ** mpf(exponent))


def exact(number):
    """The two columns of an input double: decimal and hexadecimal, both exact."""
    return [repr(number), number.hex()]


# ---------------------------------------------------------------------------------------------
# Quadrature
# ---------------------------------------------------------------------------------------------

def legendre_values(count, x):
    """P_0(x) .. P_count(x)."""
    values = [mpf(1), x]
    for j in range(1, count):
        values.append(((2 * j + 1) * x * values[j] - j * values[j - 1]) / (j + 1))
    return values


@functools.lru_cache(maxsize=None)
def gauss_legendre(count, dps):
    """Nodes and weights of the Gauss-Legendre rule on (-1, 1), ascending."""
    with mp.workdps(dps + 15):
        rule = []
        for i in range(count):
            x = -mp.cos(mp.pi * (i + mpf(3) / 4) / (count + mpf(1) / 2))
            for _ in range(12):
                p = legendre_values(count, x)
                slope = count * (x * p[count] - p[count - 1]) / (x * x - 1)
                step = p[count] / slope
                x -= step
                if abs(step) < mpf(10) ** (-(dps + 12)):
                    break
            p = legendre_values(count, x)
            slope = count * (x * p[count] - p[count - 1]) / (x * x - 1)
            rule.append((x, 2 / ((1 - x * x) * slope ** 2)))
        return rule


@functools.lru_cache(maxsize=None)
def antiderivative_matrix(count, dps):
    """Matrix that takes values at the Gauss nodes to integrals from -1 to each node."""
    rule = gauss_legendre(count, dps)
    values = [legendre_values(count + 1, x) for x, _ in rule]
    rows = []
    for p in values:
        integrals = [p[1] + 1] + [(p[j + 1] - p[j - 1]) / (2 * j + 1) for j in range(1, count)]
        scaled = [(2 * j + 1) * integrals[j] / 2 for j in range(count)]
        rows.append([weight * mp.fdot(scaled, q[:count])
                     for (_, weight), q in zip(rule, values)])
    return rows


def panel_nodes(left, right):
    """Nodes and weights of the Gauss-Legendre rule on a panel."""
    half, middle = (right - left) / 2, (right + left) / 2
    return [(middle + half * x, half * weight) for x, weight in gauss_legendre(NODES, mp.dps)]


def integrate(function, left, right):
    """Gauss-Legendre on one panel."""
    return mp.fsum(weight * function(x) for x, weight in panel_nodes(left, right))


# ---------------------------------------------------------------------------------------------
# The laws
# ---------------------------------------------------------------------------------------------

def hertz(k):
    """Exact law: Zh98 (1.3) for k <= 1; for k >= 1 Zh98 (1.5) as a 2F1, which does not cancel."""
    if k <= 1:
        return (3 * mp.pi / 32 * k * (4 - k ** 2),
                3 * mp.pi / 128 * (8 - 8 * k ** 2 + 3 * k ** 4))
    z, half = 1 / k ** 2, mpf(1) / 2
    return (mp.hyp2f1(-half, half, 5 * half, z), mp.hyp2f1(half, half, 7 * half, z) / (5 * k))


def hertz_printed(k):
    """Zh98 (1.5) as printed, k >= 1, with the digits that it loses (like k^4) added."""
    with mp.workdps(mp.dps + 10 + 4 * max(0, int(mp.log10(k)) + 1)):
        root, angle = mp.sqrt(k ** 2 - 1), mp.asin(1 / k)
        phi = 3 / (64 * k) * (4 * k ** 2 * (4 - k ** 2) * angle + 4 * (k ** 2 + 2) * root)
        psi = mpf(3) / 64 * ((8 - 8 * k ** 2 + 3 * k ** 4) * angle + 3 * (2 - k ** 2) * root)
    return +phi, +psi


def hertz_chords(k):
    """Exact law by integration over the patch, in polar coordinates (q, a) about the centre of
    velocity: every chord has centre k cos(a) and half length l, l^2 = 1 - k^2 sin^2(a), the
    pressure is (3/(2 pi)) sqrt(l^2 - (q - k cos a)^2), and the moments of the half ellipse are
    pi l^2 k cos(a)/2 (force) and pi l^4/8 (moment about the centre of the patch)."""
    end = mp.pi / 2 if k <= 1 else mp.asin(1 / k)
    phi = integrate(lambda a: mp.cos(a) ** 2 * (1 - (k * mp.sin(a)) ** 2), mpf(0), end)
    psi = integrate(lambda a: (1 - (k * mp.sin(a)) ** 2) ** 2, mpf(0), end)
    return mpf(3) / 2 * k * phi, mpf(3) / 8 * psi


def pade(k):
    """Zh98 (1.4), (1.6)."""
    return 3 * mp.pi * k / (8 + 3 * mp.pi * k), 3 * mp.pi / (16 + 15 * mp.pi * k)


def pade_from_ends(k):
    """The fractions k/(k + c) and 1/(c + d k) that fit the slope of Phi and the value of Psi at
    k = 0 and the limits of Phi and k Psi at infinity, all four of them by integration."""
    slope, value = hertz_chords(mpf(10) ** (-mp.dps))
    slope *= mpf(10) ** mp.dps
    far = mpf(10) ** mp.dps
    limit = far * hertz_chords(far)[1]
    return k / (k + 1 / slope), 1 / (1 / value + k / limit)


# ---------------------------------------------------------------------------------------------
# The pressure family, and the octic potential
# ---------------------------------------------------------------------------------------------

def pressure(p, k):
    """Pressure (1 - rho^2)^p, p >= -1, as 2F1; at k = 1 by Gauss's theorem."""
    half = mpf(1) / 2

    def series(a, b, c, z):
        if z == 1:
            return mp.gammaprod([c, c - a - b], [c - a, c - b])
        return mp.hyp2f1(a, b, c, z)

    if k <= 1:
        scale = mp.sqrt(mp.pi) * mp.gamma(p + 2) / (2 * mp.gamma(p + 5 * half))
        return (scale * (p + 3 * half) * k * series(half, -p - half, 2, k ** 2),
                scale * series(half, -p - 3 * half, 1, k ** 2))
    z = 1 / k ** 2
    return series(-half, half, p + 2, z), series(half, half, p + 3, z) / (2 * (p + 2) * k)


def pressure_chords(p, k):
    """The same over the chords of hertz_chords: the moments of (l^2 - t^2)^p on (-l, l) are l^(2p+1)
    times a beta function (force) and l^(2p+3) times another (moment).  With c the angle from the
    last chord, l^2 = 1 - k^2 + k^2 sin(c)^2 for k <= 1; for k > 1 sin(a) = cos(c)/k, l = sin(c)."""
    half = mpf(1) / 2
    force = 2 * mp.gamma(half) * mp.gamma(p + 2) / (mp.pi * mp.gamma(p + 3 * half))
    moment = 2 * mp.gamma(3 * half) * mp.gamma(p + 2) / (mp.pi * mp.gamma(p + 5 * half))
    if k <= 1:
        rest, scale = 1 - k ** 2, k ** 2
        force *= k

        def integrand(c):
            square = rest + scale * mp.sin(c) ** 2
            return mp.sin(c) ** 2 * square ** (p + half), square ** (p + 3 * half)
    else:
        rest, scale = 1 - 1 / k ** 2, 1 / k ** 2
        moment /= k

        def integrand(c):
            sine = mp.sin(c)
            cosine = mp.sqrt(rest + scale * sine ** 2)
            return sine ** (2 * p + 2) * cosine, sine ** (2 * p + 4) / cosine

    # Panels that double away from the branch points at sin(c)^2 = -rest/scale; the power of sin(c)
    # at c = 0 is left to tanh-sinh.
    edges = [mp.pi / 2]
    while rest and edges[0] > mp.sqrt(rest / scale) / 2:
        edges.insert(0, edges[0] / 2)
    total = []
    for i in range(2):
        whole = mp.quad(lambda c: integrand(c)[i], [0, edges[0]])
        for left, right in zip(edges, edges[1:]):
            whole += integrate(lambda c: integrand(c)[i], left, right)
        total.append(whole)
    return force * total[0], moment * total[1]


def octic(v, w):
    """The eighth root R of v^8 + 0.8 v^6 w^2 + 0.321466 v^4 w^4 + 8 c v^2 w^6 + c w^8."""
    c = (3 * mp.pi / 16) ** 8
    return mp.root(v ** 8 + mpf(4) / 5 * v ** 6 * w ** 2 + mpf(321466) / 10 ** 6 * v ** 4 * w ** 4
                   + 8 * c * v ** 2 * w ** 6 + c * w ** 8, 8)


def octic_law(k):
    """The gradient of octic at (k, 1)."""
    c = (3 * mp.pi / 16) ** 8
    rest = 8 * octic(k, mpf(1)) ** 7
    fourth = mpf(321466) / 10 ** 6
    return ((8 * k ** 7 + mpf(24) / 5 * k ** 5 + 4 * fourth * k ** 3 + 16 * c * k) / rest,
            (mpf(8) / 5 * k ** 6 + 4 * fourth * k ** 4 + 48 * c * k ** 2 + 8 * c) / rest)


# ---------------------------------------------------------------------------------------------
# Way 2, both laws: Taylor series of (S), (B), (O)
# ---------------------------------------------------------------------------------------------

def convolve(a, b, n):
    """Coefficient n of the product of two series."""
    return mp.fdot(a[:n + 1], b[n::-1])


def multiply(a, b):
    """Product of two series of TERMS coefficients."""
    return [convolve(a, b, n) for n in range(TERMS)]


def divide(a, b):
    """Quotient of two series, b[0] != 0."""
    quotient = []
    for n in range(TERMS):
        rest = mp.fdot(quotient, b[n:0:-1]) if n else 0
        quotient.append((a[n] - rest) / b[0])
    return quotient


def constant(value):
    """A constant as a series."""
    return [mpf(value)] + [mpf(0)] * (TERMS - 1)


def combine(*terms):
    """Linear combination of series: pairs (factor, series)."""
    return [mp.fsum(factor * series[n] for factor, series in terms) for n in range(TERMS)]


def exponential_series(rate):
    """Series of exp(rate t)."""
    series = [mpf(1)]
    for n in range(1, TERMS):
        series.append(series[-1] * rate / n)
    return series


def derivative(series):
    """Derivative of a series (the last coefficient, unknown, is set to zero)."""
    return [(n + 1) * series[n + 1] for n in range(TERMS - 1)] + [mpf(0)]


def k_series(chart, x):
    """k as a series in t = (coordinate - x); the coordinate is k, arccosh k or ln k."""
    if chart == "k":
        return [mpf(x), mpf(1)] + [mpf(0)] * (TERMS - 2)
    if chart == "log":
        return [mp.exp(x) * c for c in exponential_series(mpf(1))]
    up, down = exponential_series(mpf(1)), exponential_series(mpf(-1))
    return combine((mp.exp(x) / 2, up), (mp.exp(-x) / 2, down))


def pade_series(chart, x, k):
    """Series of Zh98 (1.4), (1.6)."""
    pi = mp.pi
    phi = divide([3 * pi * c for c in k], combine((8, constant(1)), (3 * pi, k)))
    psi = divide(constant(3 * pi), combine((16, constant(1)), (15 * pi, k)))
    return phi, psi


def hertz_series(chart, x, k):
    """Series of Zh98 (1.3) in k <= 1; of (1.5) in y = arccosh k, where sqrt(k^2 - 1) = sinh y and
    asin(1/k) has the derivative -1/cosh y; of the expansion in 1/k^2 in ln k."""
    if chart == "k":
        square = multiply(k, k)
        phi = multiply(k, combine((4, constant(1)), (-1, square)))
        psi = combine((8, constant(1)), (-8, square), (3, multiply(square, square)))
        return [3 * mp.pi / 32 * c for c in phi], [3 * mp.pi / 128 * c for c in psi]
    if chart == "log":
        return hertz_far_series(mp.exp(x))
    up, down = exponential_series(mpf(1)), exponential_series(mpf(-1))
    root = combine((mp.exp(x) / 2, up), (-mp.exp(-x) / 2, down))
    inverse = divide(constant(1), k)
    angle = [mp.atan2(1, root[0])] + [-inverse[n - 1] / n for n in range(1, TERMS)]
    square = multiply(k, k)
    first = multiply(multiply(k, combine((4, constant(1)), (-1, square))), angle)
    second = multiply(combine((1, k), (2, inverse)), root)
    third = combine((8, constant(1)), (-8, square), (3, multiply(square, square)))
    fourth = multiply(combine((2, constant(1)), (-1, square)), root)
    return (combine((mpf(3) / 16, first), (mpf(3) / 16, second)),
            combine((mpf(3) / 64, multiply(third, angle)), (mpf(9) / 64, fourth)))


def hertz_far_series(centre):
    """Phi and Psi for k = centre exp(t), summed over the powers of 1/k^2."""
    phi, psi = [[mpf(0)] * TERMS for _ in range(2)]
    half = mpf(1) / 2
    p, q, j = mpf(1), 1 / (5 * centre), 0
    while p and max(abs(p), abs(q) * centre) > mpf(10) ** (-mp.dps - 25):
        for total, coefficient, rate in ((phi, p, -2 * j), (psi, q, -2 * j - 1)):
            for n, c in enumerate(exponential_series(mpf(rate))):
                total[n] += coefficient * c
        p *= (j - half) * (j + half) / ((j + 5 * half) * (j + 1) * centre ** 2)
        q *= (j + half) ** 2 / ((j + 7 * half) * (j + 1) * centre ** 2)
        j += 1
    return phi, psi


def solve_linear(p, e, f, start):
    """Series of p y' + e y = f.  Where p[0] = 0 (the singular point k = 0) the regular solution."""
    if p[0] == 0:
        y, slope = [f[0] / e[0]], []
        for n in range(1, TERMS):
            rest = mp.fdot(p[2:n + 1], slope[n - 2::-1]) if n > 1 else mpf(0)
            rest += mp.fdot(e[1:n + 1], y[n - 1::-1])
            y.append((f[n] - rest) / (n * p[1] + e[0]))
            slope.append(n * y[n])
        return y
    y, slope = [start], []
    for n in range(TERMS - 1):
        rest = convolve(e, y, n)
        if n:
            rest += mp.fdot(p[1:n + 1], slope[n - 1::-1])
        slope.append((f[n] - rest) / p[0])
        y.append(slope[n] / (n + 1))
    return y


def safe_step(solutions):
    """Step after which the last terms of all series are below the working precision."""
    step = mpf(1)
    for series, scale in solutions:
        for n in range(TERMS - 8, TERMS):
            if series[n]:
                bound = mpf(10) ** (-mp.dps) * abs(scale) / abs(series[n])
                step = min(step, mp.root(bound, n))
    return step


class Profile:
    """sigma(k), h(k) and ln w(k) of (S), (B), (O) as a chain of Taylor series, k from 0 up.

    With `start` the chain begins at that large k with sigma = k: there (S) forgets its starting
    value like start/k."""

    def __init__(self, law, r, kappa=None, start=None):
        self.series = {"pade": pade_series, "hertz": hertz_series}[law]
        self.last_curved = mpf(3) if law == "hertz" else mpf(0)     # arccosh k from 0 to this
        self.r, self.kappa = r, kappa
        self.power = r / (2 - r)                                    # ln w ~ power ln k, k -> 0
        self.segments, self.ends = [], []
        self.chart, self.x = "k", mpf(0)
        self.values = None
        if start is not None:
            self.chart, self.x, self.values = "log", mp.log(start), (start, None, mpf(0))

    def extend(self):
        """Add one Taylor segment at the upper end."""
        chart, x, r = self.chart, self.x, self.r
        k = k_series(chart, x)
        slope = derivative(k)
        phi, psi = self.series(chart, x, k)
        d = combine((1, phi), (-r, multiply(k, psi)))
        e = [r * c for c in multiply(psi, slope)]
        sigma0, h0, log0 = self.values or (None, None, None)
        sigma = solve_linear(d, e, slope, sigma0)
        if self.values is None:
            # d(ln w - power ln k)/dk = (r k Psi - power D)/(k D), numerator O(k^2)
            top = combine((r, multiply(k, psi)), (-self.power, d))
            rate = divide(top[2:] + [mpf(0)] * 2, d[1:] + [mpf(0)])
            log0 = mpf(0)
        else:
            rate = divide(e, d)
        logarithm = [log0] + [rate[n] / (n + 1) for n in range(TERMS - 1)]
        solutions = [(sigma, sigma[0]), (logarithm[:TERMS - 4] + [mpf(0)] * 4, 1)]
        h = None
        if self.kappa is not None:
            q = multiply(combine((16, constant(1)), (15 * mp.pi, k)),
                         combine((8, constant(1)), (3 * mp.pi, k)))
            h = solve_linear([-c for c in multiply(d, q)], multiply(e, q),
                             [self.kappa * c for c in slope], h0)
            solutions.append((h, h[0]))
        end = x + safe_step(solutions)
        self.segments.append((chart, x, sigma, h, logarithm))
        self.advance(chart, end)

    def advance(self, chart, end):
        """Close the last segment and choose the coordinate of the next."""
        following = chart
        if chart == "k" and end >= 1:
            end, following = mpf(1), "arccosh" if self.last_curved else "log"
        elif chart == "arccosh" and end >= self.last_curved:
            end, following = self.last_curved, "log"
        k = {"k": end, "arccosh": mp.cosh(end), "log": None}[chart]
        if k is None:
            k = mp.exp(end)
        self.ends.append(k)
        self.values = self.at_segment(len(self.segments) - 1, k)
        self.chart = following
        if following == chart:
            self.x = end
        else:
            self.x = mpf(0) if following == "arccosh" else mp.log(k)

    def at_segment(self, index, k):
        """(sigma, h, ln w) at k from the series of one segment."""
        chart, x, sigma, h, logarithm = self.segments[index]
        coordinate = {"k": lambda: k, "arccosh": lambda: mp.acosh(k), "log": lambda: mp.log(k)}
        t = coordinate[chart]() - x
        log_w = mp.polyval(logarithm[TERMS - 5::-1], t)
        if chart == "k" and x == 0 and k:
            log_w += self.power * mp.log(k)
        return (mp.polyval(sigma[::-1], t), None if h is None else mp.polyval(h[::-1], t), log_w)

    def __call__(self, k):
        """(sigma, h, ln w) at k."""
        while not self.ends or self.ends[-1] < k:
            self.extend()
        return self.at_segment(bisect.bisect_left(self.ends, k), k)


# ---------------------------------------------------------------------------------------------
# Way 1, Pade: closed forms
# ---------------------------------------------------------------------------------------------

class PadeClosed:
    """Closed forms for the Pade law Zh98 (1.4), (1.6), r < 2.

    a = r/(2-r), e = r/(5-r), b = a - e, A = 8(2-r), B = 3 pi (5-r) (common factors dropped):
    orbit u ~ k^a (A+Bk)^(-b); the time left and beta are one 2F1 each."""

    def __init__(self, r, kappa):
        self.r, self.kappa = r, kappa
        self.a, self.e = r / (2 - r), r / (5 - r)
        self.b = self.a - self.e
        self.big_a, self.big_b = 8 * (2 - r), 3 * mp.pi * (5 - r)

    def log_w(self, y):
        """ln w on the orbit, y = ln k, up to a constant."""
        return self.a * y - self.b * mp.log(self.big_a + self.big_b * mp.exp(y))

    def sigma(self, k):
        """Time left over w: 16/(3 pi r) + k + (3/2) k y 2F1(1, b+1; a+2; x), x = Bk/(A+Bk),
        y = 1 - x."""
        with mp.workdps(mp.dps + 30 + min(150, int(abs(mp.log10(1 + k))))):
            bottom = self.big_a + self.big_b * k
            x, y = self.big_b * k / bottom, self.big_a / bottom
            series = mp.hyp2f1(1, self.b + 1, self.a + 2, x) if x else mpf(1)
            value = 16 / (3 * mp.pi * self.r) + k + mpf(3) / 2 * k * y * series
        return +value

    def h(self, k):
        """Solution of (B): -k(A+Bk) h' + r (8 + 3 pi k) h = kappa/(3 pi); a 2F1 of -Bk/A."""
        z = -self.big_b * k / self.big_a
        return (self.kappa / (24 * mp.pi * self.r)
                * mp.hyp2f1(-self.e, 1, 1 - self.a, z))

    def beta(self, k0, k, w0, w):
        """Regularised time from k0 to k."""
        with mp.workdps(mp.dps + 30):
            return self.h(k) / w - self.h(k0) / w0


# ---------------------------------------------------------------------------------------------
# Way 1, Hertz: quadrature
# ---------------------------------------------------------------------------------------------

@functools.lru_cache(maxsize=None)
def curved_panel(left, right, dps):
    """Nodes y, weights and (k, dk/dy, Phi, Psi) on a panel of y = arccosh k."""
    return [(weight, mp.cosh(y), mp.sinh(y), hertz(mp.cosh(y)))
            for y, weight in panel_nodes(left, right)]


class HertzQuadrature:
    """Time left and beta for the exact law by quadrature of the separated equation (O).

    sigma = 1/(r Psi(0)) + (1/w) Int_0^k w (1 - Psi/Psi(0))/D dk.  Normalised to w = 1 at k = 1.
    k <= 1: closed orbit, panels in ln k.  k >= 1: panels in y = arccosh k, orbit by integration."""

    def __init__(self, r, kappa):
        self.r, self.kappa = r, kappa
        self.psi0 = 3 * mp.pi / 16
        self.closed_orbit(r)
        self.panels = None

    def closed_orbit(self, r):
        """Roots and exponents of w = s^(a/2) |1 - s/s+|^e+ |1 - s/s-|^e-, s = k^2: partial
        fractions of d ln w/ds = r (8-8s+3s^2)/(2 s [4(4-s) - r(8-8s+3s^2)])."""
        with mp.workdps(mp.dps + 100):
            root = mp.sqrt((4 * r - 2) ** 2 + 3 * r * (16 - 8 * r))
            plus, minus = (4 * r - 2 + root) / (3 * r), (4 * r - 2 - root) / (3 * r)
            self.roots = plus, minus
            self.exponents = [-2 * (4 - one) / (3 * r * one * (one - other))
                              for one, other in ((plus, minus), (minus, plus))]
            self.power = r / (2 - r)
            self.offset = mpf(0)
            self.offset = self.log_w_low(mpf(0))

    def log_w_low(self, y):
        """ln w for y = ln k <= 0."""
        s = mp.exp(2 * y)
        return self.power * y - self.offset + mp.fsum(
            exponent * mp.log(1 - s / root)
            for root, exponent in zip(self.roots, self.exponents))

    def bracket(self, s):
        """128 D/(3 pi k) for k <= 1."""
        return 4 * (4 - s) - self.r * (8 - 8 * s + 3 * s * s)

    def panels_down(self, top, bottom):
        """Panel edges in ln k from top down to bottom: short ones near k = 1."""
        while top > bottom:
            length = mpf(1) / 2 if top > -3 else mpf(2)
            yield max(bottom, top - length), top
            top -= length

    def time_low(self, y):
        """Int_0^k w (1 - Psi/Psi(0))/D dk, k = exp(y) <= 1; the integrand falls like k^2."""
        if y < -(mp.dps + 10) * mp.ln10:
            return mpf(0)

        def integrand(x):
            s = mp.exp(2 * x)
            return mp.exp(self.log_w_low(x)) * 16 * s * (8 - 3 * s) / (3 * mp.pi * self.bracket(s))
        bottom = y - (mp.dps + 5) * mp.ln10 / 2
        return mp.fsum(integrate(integrand, *edges) for edges in self.panels_down(y, bottom))

    def beta_low(self, y):
        """kappa Int_k^1 dk/(w D Q), k = exp(y) <= 1; the limit k -> 0, which integrates to 1/w, is
        taken out, so that the rest falls like k."""
        def integrand(x):
            k, s = mp.exp(x), mp.exp(2 * x)
            rest = 1 / weight(k) - (8 - 8 * s + 3 * s * s) / (8 * weight(mpf(0)))
            return mp.exp(-self.log_w_low(x)) * rest * 128 / (3 * mp.pi * self.bracket(s))

        def weight(k):
            return (16 + 15 * mp.pi * k) * (8 + 3 * mp.pi * k)
        bottom = max(y, -(mp.dps + 5) * mp.ln10)
        rest = mp.fsum(integrate(integrand, *edges)
                       for edges in self.panels_down(mpf(0), bottom))
        leading = (mp.exp(-self.log_w_low(y)) - 1) / (self.r * self.psi0 * weight(mpf(0)))
        return self.kappa * (leading + rest)

    def panel(self, left, right, state):
        """One panel in y = arccosh k: (ln w, time integral, beta integral) at its upper end."""
        log_w, elapsed, beta = state
        nodes = curved_panel(left, right, mp.dps)
        half = (right - left) / 2
        rates, elapsed_rates, beta_rates = [], [], []
        for _, k, slope, (phi, psi) in nodes:
            d = phi - self.r * k * psi
            rates.append(self.r * psi * slope / d)
            elapsed_rates.append((1 - psi / self.psi0) * slope / d)
            beta_rates.append(slope / (d * (16 + 15 * mp.pi * k) * (8 + 3 * mp.pi * k)))
        inside = [mp.exp(log_w + half * mp.fdot(row, rates))
                  for row in antiderivative_matrix(NODES, mp.dps)]
        weights = [weight for weight, _, _, _ in nodes]
        elapsed += mp.fdot(weights, [w * rate for w, rate in zip(inside, elapsed_rates)])
        beta += self.kappa * mp.fdot(weights, [rate / w for w, rate in zip(inside, beta_rates)])
        return log_w + mp.fdot(weights, rates), elapsed, beta

    def high(self, k):
        """(ln w, time integral, beta integral from 1) for k >= 1."""
        y = mp.acosh(k)
        far = (mp.dps + 10) * mp.ln10
        if y > far + 20:                            # what lies below does not matter
            left, state = mp.floor(y - far), (mpf(0), mpf(0), mpf(0))
            while left + 1 < y:
                state = self.panel(left, left + 1, state)
                left += 1
            return self.panel(left, y, state)
        if self.panels is None:
            self.panels = [(mpf(0), self.time_low(mpf(0)), mpf(0))]
        count = int(mp.floor(y))
        while len(self.panels) <= count:
            left = mpf(len(self.panels) - 1)
            self.panels.append(self.panel(left, left + 1, self.panels[-1]))
        return self.panel(mpf(count), y, self.panels[count]) if y > count else self.panels[count]

    def sigma_log_w(self, y):
        """(sigma, ln w) at ln k = y."""
        if y <= 0:
            log_w, elapsed = self.log_w_low(y), self.time_low(y)
        else:
            log_w, elapsed, _ = self.high(mp.exp(y))
        return 1 / (self.r * self.psi0) + elapsed * mp.exp(-log_w), log_w

    def sigma(self, k):
        """Time left over w."""
        return self.sigma_log_w(mp.log(k))[0] if k else 1 / (self.r * self.psi0)

    def beta_normal(self, y):
        """Minus beta from k = 1 on the orbit through w = 1 at k = 1."""
        return -self.beta_low(y) if y <= 0 else self.high(mp.exp(y))[2]

    def log_w(self, y):
        """ln w at ln k = y."""
        return self.sigma_log_w(y)[1]

    def beta(self, k0, k, w0, w):
        """Regularised time from k0 to k."""
        scale = mp.exp(self.log_w(mp.log(k0))) / w0
        return scale * (self.beta_normal(mp.log(k0)) - self.beta_normal(mp.log(k)))


# ---------------------------------------------------------------------------------------------
# Stop times and states in two ways
# ---------------------------------------------------------------------------------------------

class Body:
    """A body with a law: both ways of computing, shared by all starts with the same mu."""

    def __init__(self, law, mu, chi=mpf(7) / 2, gamma=mpf(5) / 2, with_beta=False):
        self.law = law
        self.mu, self.chi, self.gamma = mpf(mu), mpf(chi), mpf(gamma)
        self.r = self.gamma * self.mu ** 2 / self.chi
        self.kappa = 3 * mp.pi / (2 * self.chi)
        self.first = (PadeClosed if law == "pade" else HertzQuadrature)(self.r, self.kappa)
        self.second = Profile(law, self.r, self.kappa if with_beta else None)

    def stop(self, u, v):
        """Stop time tau* and agreed digits."""
        w, v = self.mu * abs(mpf(u)), mpf(v)
        if w == 0:                                  # v/k -> 0: only sliding
            pair = self.kappa * v, self.stop_taylor(v * mpf(10) ** (-mp.dps - 5), v)
        else:
            pair = self.kappa * w * self.first.sigma(v / w), self.stop_taylor(w, v)
        return pair[0], check([pair], "stop %s mu=%s u=%s v=%s" % (self.law, self.mu, u, v))

    def stop_taylor(self, w, v):
        """Stop time by Taylor series."""
        k, reach = v / w, mpf(10) ** (mp.dps + 5)
        profile = self.second
        if k > reach * 10 ** 5:
            profile = Profile(self.law, self.r, start=k / reach)
        return self.kappa * w * profile(k)[0]

    def state(self, u, v, tau):
        """State at tau: (|u|, ln v, k, beta) and agreed digits."""
        w0, k0 = self.mu * abs(mpf(u)), mpf(v) / (self.mu * abs(mpf(u)))
        left = self.kappa * w0 * self.first.sigma(k0) - tau
        second = self.state_taylor(w0, k0, left)
        guess = mpf(mp.nstr(second[0], 15))
        first = self.state_direct(w0, k0, left, guess)
        rows = [self.outputs(state) for state in (first, second)]
        where = "state %s mu=%s u=%s v=%s tau=%s" % (self.law, self.mu, u, v, tau)
        return rows[0], check(list(zip(*rows)), where)

    def outputs(self, state):
        """(|u|, ln v, k, beta) from (ln k, ln w, beta)."""
        y, log_w, beta = state
        return mp.exp(log_w) / self.mu, y + log_w, mp.exp(y), beta

    def newton(self, left, y, evaluate):
        """Solve time left = kappa w sigma for y = ln k; d ln(w sigma)/dy = k/(D sigma)."""
        law = hertz if self.law == "hertz" else pade
        for _ in range(200):
            sigma, log_w = evaluate(y)
            k = mp.exp(y)
            phi, psi = law(k)
            slope = 1 / ((phi / k - self.r * psi) * sigma)
            step = (log_w + mp.log(self.kappa * sigma) - mp.log(left)) / slope
            y -= step
            if abs(step) < mpf(10) ** (10 - mp.dps) * max(1, abs(y)):
                return y, evaluate(y)[1]
        raise Disagreement("Newton does not converge")

    def state_taylor(self, w0, k0, left):
        """(ln k, ln w, beta) by Taylor series; ln(w sigma) is convex in ln k, so that Newton's
        method descends monotonically from the start."""
        log_k0 = mp.log(k0)
        _, h0, log0 = self.second(k0)
        log0 = mp.log(w0) - log0

        def evaluate(y):
            sigma, _, log_w = self.second(mp.exp(y))
            return sigma, log_w + log0
        y, log_w = self.newton(left, log_k0, evaluate)
        h = self.second(mp.exp(y))[1]
        return y, log_w, h / mp.exp(log_w) - h0 / w0

    def state_direct(self, w0, k0, left, guess):
        """(ln k, ln w, beta) by closed forms (Pade) or quadrature (Hertz)."""
        way = self.first
        log0 = mp.log(w0) - way.log_w(mp.log(k0))

        def evaluate(y):
            if self.law == "hertz":
                sigma, log_w = way.sigma_log_w(y)
                return sigma, log_w + log0
            return way.sigma(mp.exp(y)), way.log_w(y) + log0
        y, log_w = self.newton(left, guess, evaluate)
        return y, log_w, way.beta(k0, mp.exp(y), w0, mp.exp(log_w))


# ---------------------------------------------------------------------------------------------
# The tables
# ---------------------------------------------------------------------------------------------

MUS = [1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 0.0035, 0.01, 0.05, 0.099, 0.1, 0.241, 0.3, 0.5, 0.7, 0.9,
       1.0]

EXTREMES = [                                        # (mu, u0, v0)
    (0.1, 0.0, 1.0), (1e-10, 0.0, 1.0), (1.0, 0.0, 3.5), (0.3, 0.0, 1e-290),
    (0.3, 1.0, 0.0), (1e-10, 1.0, 0.0), (1.0, 2.0, 0.0), (0.1, 1e-290, 0.0),
    (0.1, -1.0, 1.0), (0.3, -2.5, 0.4), (1e-3, -1.0, 1e-3), (1.0, -1.0, 2.0), (0.1, -1.0, 0.0),
    (0.1, 1e-300, 1e300), (1e-10, 1e-300, 1e300), (0.01, 1e-308, 1e308),
    (0.1, 1e300, 1e-300), (1.0, 1e200, 1e-200), (1e-10, 1e297, 1e-300),
    (1e-10, 1e297, 1.0), (1e-10, 1e297, 1e297), (1e-10, 5e297, 1e300),
    (0.1, 5e306, 3e306), (1.0, 3e307, 5e307), (0.3, -2e306, 1e308), (0.1, 1e100, 1e100),
    (0.1, 1e-293, 1e-292), (1.0, 1e-291, 1e-290), (1e-10, 1e-301, 1e-300), (0.3, 1e-290, 1e-295),
    (0.1, 1.0, 5e-324), (1e-10, 1.0, 5e-324), (0.1, 5e-324, 1.0), (1e-10, 5e-324, 1.0),
    (0.1, 1.0, 1e-310), (0.1, -1e-310, 1.0),
]

HERTZ_EXTREMES = [EXTREMES[i] for i in (0, 1, 3, 4, 5, 7, 8, 9, 11, 13, 16, 19, 21, 22, 23, 26, 28,
                                        30, 31, 32)]


def law_points():
    """Values of k for laws.csv."""
    ulp, edge = 2.0 ** -52, 1.25
    points = [1e-300, 1e-200, 1e-100, 1e-20, 1e-12, 1e-8, 1e-5, 1e-3, 0.01, 0.1, 0.25, 0.5, 0.5392,
              0.75, 0.9, 0.9059, 0.99, 0.999999, 1 - ulp / 2, 1.0, 1 + ulp, 1 + 1e-12, 1.000001,
              1.0001, 1.01, 1.1, 1.2, 1.2499, edge - ulp, edge, edge + ulp, 1.2501, 1.3, 1.5, 2.0,
              3.0, 5.0, 10.0, 30.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10, 1e16, 1e30, 1e100, 1e200,
              1e300]
    dice = random.Random(SEED)
    points += [power_of_ten(dice.uniform(-3, 3)) for _ in range(40)]
    return sorted(points)


def table_laws():
    """Both laws at single points."""
    yield ["k", "k_hex", "phi_hertz", "psi_hertz", "phi_pade", "psi_pade", "digits"]
    for number in law_points():
        k = mpf(number)
        first = hertz(k) + pade(k)
        pairs = list(zip(first, hertz_chords(k) + pade_from_ends(k)))
        if k >= 1:
            pairs += list(zip(first, hertz_printed(k)))
        digits = check(pairs, "laws k=%s" % number)
        yield exact(number) + [text(value) for value in first] + [digits]


PRESSURES = {"uniform": 0.0, "punch": -0.5, "ring": -1.0, "pressure:-0.3": -0.3, "pressure:1.7": 1.7,
             "pressure:25": 25.0}


def pressure_points():
    """Values of k for laws_pressure.csv: those of laws.csv, more of them near k = 1."""
    dice = random.Random(SEED)
    points = [0.7071067811865475, 0.7071067811865476, 1.414213562373095, 1.4142135623730951,
              1 - 2.0 ** -52, 1 + 2.0 ** -51]
    points += [1 + sign * power_of_ten(dice.uniform(-15, -1)) for sign in (-1, 1) for _ in range(12)]
    return sorted(set(law_points() + points))


def table_laws_pressure():
    """The pressure family at single points."""
    columns = ["%s_%s" % (part, law) for law in PRESSURES
               for part in ("phi", "psi")]
    yield ["k", "k_hex"] + columns + ["digits"]
    for number in pressure_points():
        k = mpf(number)
        first, second = (), ()
        for p in PRESSURES.values():
            first += pressure(mpf(p), k)
            second += pressure_chords(mpf(p), k)
        digits = check(list(zip(first, second)), "laws_pressure k=%s" % number)
        yield exact(number) + [text(value) for value in first] + [digits]


def stop_points(per_mu, extra_mus, extremes):
    """(mu, u0, v0): k0 = v0/(mu u0) from 1e-6 to 1e8, spread and random, and the extremes."""
    dice = random.Random(SEED)
    points = []
    for mu in MUS + [power_of_ten(dice.uniform(-10, 0)) for _ in range(extra_mus)]:
        count = per_mu if mu in MUS else 2
        for i in range(count):
            k0 = power_of_ten(-6 + 14 * (i + dice.random()) / count)
            u0 = dice.choice([1.0, 0.25, power_of_ten(dice.uniform(-2, 2))])
            points.append((mu, u0, k0 * mu * u0))
    return sorted(points + extremes)


def stop_table(law, points):
    """Stop times of the ball."""
    yield ["mu", "mu_hex", "u0", "u0_hex", "v0", "v0_hex", "tau_stop", "digits"]
    body = None
    for mu, u0, v0 in points:
        if body is None or body.mu != mu:
            body = Body(law, mu)
        tau, digits = body.stop(u0, v0)
        yield exact(mu) + exact(u0) + exact(v0) + [text(tau), digits]


TRAJECTORY_MUS = [1e-4, 1e-3, 0.0035, 0.01, 0.099, 0.1, 0.241, 0.3, 0.7, 1.0]
FRACTIONS = [1e-6, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 0.999]
STARTS = [1e-3, 0.5, 2.5, 1e5, 0.05, 1.0, 30.0, 1e3]                # k0
BALLS = {0.0035: (1.0, 0.5), 0.099: (2.8575, 1.0), 0.241: (0.9, 0.5)}    # (u0, v0)


def trajectory_points():
    """(mu, u0, v0, fraction): four starts for each mu, three of the fractions for each start."""
    points, number = [], 0
    for i, mu in enumerate(TRAJECTORY_MUS):
        starts = []
        for j in range(4):
            u0 = (1.0, -2.0, 0.5, 4.0)[(i + j) % 4]
            starts.append((u0, STARTS[(4 * i + j) % len(STARTS)] * mu * abs(u0)))
        if mu in BALLS:
            starts[1] = BALLS[mu]
        for u0, v0 in starts:
            for j in range(3):
                points.append((mu, u0, v0, FRACTIONS[(5 * number + 4 * j) % len(FRACTIONS)]))
            number += 1
    return points


def trajectory_table(law, points):
    """States of the ball at the exact double nearest to fraction tau*."""
    yield ["mu", "mu_hex", "u0", "u0_hex", "v0", "v0_hex", "tau_stop", "fraction", "tau",
           "tau_hex", "u", "ln_v", "k", "beta", "digits"]
    body = None
    for mu, u0, v0, fraction in points:
        if body is None or body.mu != mu:
            body = Body(law, mu, with_beta=True)
        stop, digits = body.stop(u0, v0)
        tau = double(fraction * stop)
        (u, log_v, k, beta), more = body.state(u0, v0, mpf(tau))
        u = u if u0 > 0 else -u
        yield (exact(mu) + exact(u0) + exact(v0) + [text(stop), repr(fraction)] + exact(tau)
               + [text(value) for value in (u, log_v, k, beta)] + [min(digits, more)])


BODIES = [                                          # (chi, gamma, mu, u0, v0)
    (2.5, 1.5, 0.1, 1.0, 1.0),                      # hollow ball
    (2.5, 1.5, 1.0, 0.5, 2.0),
    (1.5, 4.0, 0.05, 2.0, 0.25),                    # gyroscope
    (1.5, 4.0, 0.5, -1.0, 1.0),
    (1.5, 4.0, 0.75, 1.0, 0.5),
    (1.0, 2.0, 0.5, 1.0, 1.0),                      # puck
    (1.0, 2.0, 0.9, 2.0, 40.0),
    (1.0, 1.5, 1.0, 1.0, 0.01),
    (3.5, 2.5, 0.3, 1.0, 0.3),                      # ball
    (6.0, 3.25, 0.01, 3.0, 0.03),
]


def table_bodies():
    """Stop times of bodies of other inertia."""
    yield ["law", "chi", "gamma", "mu", "mu_hex", "u0", "u0_hex", "v0", "v0_hex", "tau_stop",
           "digits"]
    for law in ("pade", "hertz"):
        for chi, gamma, mu, u0, v0 in BODIES:
            tau, digits = Body(law, mu, chi, gamma).stop(u0, v0)
            yield ([law, repr(chi), repr(gamma)] + exact(mu) + exact(u0) + exact(v0)
                   + [text(tau), digits])


# ---------------------------------------------------------------------------------------------
# Invariant rays: any law, any number of rays, starts on and beside them
# ---------------------------------------------------------------------------------------------

def elliptic(k):
    """Parameter m = min(k, 1/k)^2, 1 - m, and the complete elliptic integrals of m by the arithmetic-geometric mean, as
    mpmath's 2F1 is slow at k = 1 and its E loses digits there."""
    modulus = min(k, 1 / k)
    rest = (1 - modulus) * (1 + modulus)
    a, b, share, power = mpf(1), mp.sqrt(rest), modulus ** 2 / 2, mpf(1) / 2
    while abs(a - b) > mpf(10) ** (-mp.dps) * a:
        a, b, c = (a + b) / 2, mp.sqrt(a * b), (a - b) / 2
        power *= 2
        share += power * c ** 2
    first = mp.pi / (2 * a)
    return modulus ** 2, rest, first, first * (1 - share)


def ring(k):
    """Pressure of a thin ring."""
    if k == 1:
        return 2 / mp.pi, 2 / mp.pi
    square, rest, first, second = elliptic(k)
    one = 2 / mp.pi * second
    other = 2 / (mp.pi * mp.sqrt(square)) * (second - rest * first)
    return (other, one) if k < 1 else (one, other)


def uniform(k):
    """Uniform pressure."""
    if k == 1:
        return 8 / (3 * mp.pi), 8 / (9 * mp.pi)
    _, _, first, second = elliptic(k)
    s = k ** 2
    if k < 1:
        return (4 / (3 * mp.pi * k) * ((s + 1) * second + (s - 1) * first),
                4 / (9 * mp.pi) * ((4 - 2 * s) * second + (s - 1) * first))
    return (4 / (3 * mp.pi) * ((s + 1) * second - (s - 1) * first),
            4 * k / (9 * mp.pi) * ((4 - 2 * s) * second + (2 * s - 5 + 3 / s) * first))


def law_named(name):
    """(Phi, Psi) of k for a law of the table of rays."""
    laws = {"exact": hertz, "pade": pade, "uniform": uniform, "ring": ring, "octic": octic_law}
    if name in laws:
        return laws[name]
    exponent = -mpf(1) / 2 if name == "punch" else mpf(name.split(":")[1])
    return lambda k: pressure(exponent, k)


def eliminate(matrix, right):
    """Solve a linear system, by lists."""
    rows = [row + [b] for row, b in zip(matrix, right)]
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda j: abs(rows[j][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for j in range(i + 1, n):
            factor = rows[j][i] / rows[i][i]
            if factor:
                rows[j] = rows[j][:i + 1] + [b - factor * a for a, b in zip(rows[i][i + 1:], rows[j][i + 1:])]
    x = [mpf(0)] * n
    for i in range(n - 1, -1, -1):
        x[i] = (rows[i][n] - mp.fdot(rows[i][i + 1:n], x[i + 1:])) / rows[i][i]
    return x


def graded(start, end, kink, length, least):
    """Panels from start to end in a variable x, as functions (x(s), dx/ds) on -1 < s < 1: even ones of that length, and
    next to the kink, where distances to it down to `least` count, even ones in their logarithm."""
    sign = 1 if end > start else -1

    def even(left, right):
        half, middle = (right - left) / 2, (right + left) / 2
        return lambda s: (middle + half * s, half)

    def logarithmic(near, far, side):       # x = kink + side exp(t), t from ln near to ln far
        a, b = mp.log(near), mp.log(far)
        half, middle = (b - a) / 2, (b + a) / 2

        def at(s):
            distance = side * mp.exp(middle + half * s)
            return kink + distance, half * distance
        return at

    x = start
    while sign * (end - x) > 0:
        ahead = sign * (kink - x)           # > 0: the kink is still to come
        distance = abs(ahead)
        across = 0 < ahead < 2 * least      # where nothing of it is left to see
        if across:
            right = kink + sign * least
        elif ahead > 0 and distance < mpf(17) / 16:
            right = kink - sign * max(distance * mp.exp(-2), least)
        elif ahead <= 0 and distance < mpf(15) / 16:
            right = kink + sign * min(max(distance, least) * mp.exp(2), mpf(1))
        else:
            right = x + sign * length
            if ahead > 0 and sign * (kink - right) < 1:
                right = kink - sign
        if sign * (end - right) < 0:
            right = end
        if not across and 0 < min(distance, abs(right - kink)) and max(distance, abs(right - kink)) < mpf(17) / 16:
            side = 1 if x > kink else -1
            yield logarithmic(abs(x - kink), abs(right - kink), side)
        else:
            yield even(x, right)
        x = right


class RaySystem:
    """A law and an r exactly; stop times of starts in both ways."""

    NODES = 40
    LEAST = mpf(10) ** -36

    def __init__(self, law, r):
        self.law, self.r = law_named(law), r
        self.least = self.LEAST if law in ("ring", "uniform") else mpf(10) ** -16   # weaker kinks
        self.psi0 = self.law(mpf(10) ** -200)[1]

    def excess(self, x):
        """D = Phi - r k Psi at ln k = x."""
        phi, psi = self.law(mp.exp(x))
        return phi - self.r * mp.exp(x) * psi

    def end(self, x):
        """ln k that a start with ln k = x tends to."""
        sign = 1 if self.excess(x) > 0 else -1
        step, far = mpf(1) / 8, 60
        while abs(x) < far and sign * self.excess(x - sign * step) > 0:
            x -= sign * step
        if abs(x) >= far:
            return -sign * mp.inf
        # False position (Illinois); a bracket of two points that the excess does not tell apart is the root.
        low, high = x - sign * step, x
        at_low, at_high = self.excess(low), self.excess(high)
        while at_low != at_high and abs(high - low) > mpf(10) ** (5 - mp.dps):
            middle = high - at_high * (high - low) / (at_high - at_low)
            at_middle = self.excess(middle)
            if at_middle * at_high < 0:
                low, at_low = high, at_high
            else:
                at_low /= 2
            high, at_high = middle, at_middle
            if at_middle == 0 or middle == low:
                return middle
        return high

    def by_orbit(self, k0, k_end):
        """Time left over w, scaled: the integral of w along the orbit over z, where the distance of k (of 1/k from
        below) from its end is that of the start times exp(-z)."""
        falls = k0 > k_end
        end = k_end if falls else 1 / k_end if k_end != mp.inf else mpf(0)
        distance = abs((k0 if falls else 1 / k0) - end)
        if distance < mpf(10) ** -42 * end:
            return 1 / (self.r * self.law(k0)[1])
        total, log_w, z = mpf(0), mpf(0), mpf(0)
        kink = mp.log(distance / (1 - end)) if end < 1 < end + distance else -mpf(10) ** 9
        rule = gauss_legendre(self.NODES, mp.dps)
        antiderivative = antiderivative_matrix(self.NODES, mp.dps)

        def rates(z):
            gap = distance * mp.exp(-z)
            y = end + gap
            k = y if falls else 1 / y
            phi, psi = self.law(k)
            q = gap * (1 if falls else k * k) / abs(phi - self.r * k * psi)
            return q, self.r * psi * q

        while True:
            # e-folds of w a panel: at most 6, and at most 1 of the distance.
            steep = rates(z + mpf(10) ** -30)[1]
            stop = z + min(mpf(1), 6 / steep)
            for chart in graded(z, stop, kink, mpf(1), self.least):
                places = [chart(s) for s, _ in rule]
                values = [(rates(x), slope) for x, slope in places]
                inside = [mp.exp(log_w - mp.fdot(row, [rate[1] * slope for rate, slope in values]))
                          for row in antiderivative]
                weights = [weight for _, weight in rule]
                total += mp.fdot(weights, [w * rate[0] * slope for w, (rate, slope) in zip(inside, values)])
                log_w -= mp.fdot(weights, [rate[1] * slope for rate, slope in values])
            z = stop
            if log_w < -95:
                return total
            gap = distance * mp.exp(-z)
            if gap < mpf(10) ** -42 * max(end, mpf(10) ** -3):
                k = end + gap if falls else 1 / (end + gap)
                psi = self.law(k)[1]
                return total + mp.exp(log_w) * (1 / (self.r * psi) if k_end != mp.inf else k)

    def by_regular_solution(self, starts, k_end):
        """{k0: time left over w}: m of D dm/dx + Phi m = 1 - Psi/Psi(0), x = ln k, from the end on one side, by
        collocation at Gauss points for the values of dm/ds."""
        up = starts[0] > k_end
        starts = sorted(starts, reverse=not up)
        rule = gauss_legendre(self.NODES, mp.dps)
        antiderivative = antiderivative_matrix(self.NODES, mp.dps)
        weights = [weight for _, weight in rule]
        edge = mp.log(k_end) if k_end not in (0, mp.inf) else mpf(-46 if up else 46)

        def at(x):
            k = mp.exp(x)
            phi, psi = self.law(k)
            return phi - self.r * k * psi, phi, 1 - psi / self.psi0

        # Where D is small from the first m is on (1 - Psi/Psi(0))/Phi but for its next term.
        _, phi, deficit = at(edge)
        m = deficit / phi
        if k_end in (0, mp.inf):
            h = mpf(10) ** -25
            slope = (at(edge + h)[2] / at(edge + h)[1] - m) / h
            m -= at(edge)[0] / phi * slope
        result = {}
        for k0 in starts:
            for chart in graded(edge, mp.log(k0), mpf(0), mpf(1) / 2, self.least):
                rows = []
                for (s, _), row in zip(rule, antiderivative):
                    x, slope = chart(s)
                    drag, phi, deficit = at(x)
                    rows.append(([phi * slope * a for a in row], drag, (deficit - phi * m) * slope))
                for i, (row, drag, _) in enumerate(rows):
                    row[i] += drag
                slopes = eliminate([row for row, _, _ in rows], [right for _, _, right in rows])
                m += mp.fdot(weights, slopes)
            edge = mp.log(k0)
            result[k0] = 1 / (self.r * self.psi0) + k0 * m
        return result


RAYS = [                                            # law, chi, gamma, mu, u0, [v0]
    ("uniform", 1.0, 2.0, 1.0, 1.0, [0.6530017892055977, 0.6530017892055975, 0.65300178920, 0.6530017893, 0.65, 3.0]),
    ("uniform", 1.0, 3.0, 1.0, 1.0, [1.0, 1.0000000001, 0.999, 0.25, 40.0]),
    ("ring", 1.0, 1.0, 1.0, 1.0, [1.0, 1.0000000000000002, 0.9999999999, 1.00001, 0.999, 1.01, 0.9, 1.5, 0.3]),
    ("exact", 1.0, 2.5, 1.0, 1.0, [0.5377791498567294, 0.5377791498567, 0.53778, 0.1, 2.0]),
    ("exact", 1.0, 4.999991639655138, 1.0, 1.0, [320.19512152011197, 320.1951, 400.0, 3.0]),
    ("exact", 1.0, 2.0, 1.0, 1.0, [1e-7, 1e-3, 0.5, 30.0]),
    ("exact", 1.0, 5.0, 1.0, 1.0, [1e6, 1e3, 2.0, 0.01]),
    ("pressure:3", 1.0, 9.99999999996235, 1.0, 1.0, [156035.19756054794]),
    ("pressure:7", 1.0, 17.999999999919748, 1.0, 0.00426416748376288, [466.13132272670447]),
    ("pressure:7", 1.0, 18.0, 1.0, 1.0, [1e6, 1e3]),
    ("punch", 1.0, 1.0000000000003053, 1.0, 1.0, [1e-6, 1e-4, 0.01, 0.3]),
    ("octic", 1.0, 2.0, 1.0, 1.0, [1e-3, 0.05, 0.2081, 0.3, 5.0]),
    ("octic", 1.0, 1.995, 1.0, 1.0, [0.01, 0.09, 0.096, 0.097, 0.15, 0.18, 0.19, 3.0]),
    ("octic", 1.0, 1.991, 1.0, 1.0, [0.1, 0.139, 0.144, 0.149, 0.2]),
    ("pade", 1.0, 3.0, 1.0, 1.0, [0.4244131815783876, 0.42441318, 0.1, 7.0]),
    ("pade", 1.0, 4.99999996736674, 1.0, 1.0, [78036093.0, 1e4]),
] + [                                               # balls in every regime, also at mu^2 = 14/5 and 7
    ("pade", 3.5, 2.5, mu, u0, [v0]) for mu, u0, v0 in (
        (1.2, 0.18257418583505539, 5.477225575051661), (1.5, 0.18257418583505539, 5.477225575051661),
        (1.5, 0.01, 100.0), (1.6, 0.18257418583505539, 5.477225575051661), (1.6733190530681512, 10.0, 0.1),
        (1.6733200530681511, 1.0, 1.0), (1.7, 10.0, 0.1), (2.0, 0.18257418583505539, 5.477225575051661),
        (2.0, 0.01, 100.0), (2.3, 10.0, 0.1), (2.3, 1.8257418583505538, 0.5477225575051661),
        (2.6457513110645907, 1.8257418583505538, 0.5477225575051661), (2.6467513110645906, 1.0, 1.0), (3.0, 3.0, 0.25))
] + [
    ("uniform", 3.5, 2.5, 0.1, 0.25, [4.0]), ("uniform", 3.5, 2.5, 1.0, 0.25, [4.0]),
    ("uniform", 1.0, 1.0, 1.0, 1.0, [0.05, 0.6, 3.0]), ("uniform", 1.0, 1.0, 1.0, 0.25, [4.0]),
    ("ring", 3.5, 2.5, 1.0, 1.0, [0.05, 0.6, 3.0]),
]


def ray_points():
    """RAYS; and for each law r next to both ends of the domain of rays and in its middle, starts on the ray, beside it
    and far from it."""
    points = list(RAYS)
    for law, low, high in (("uniform", 1.5, 4.0), ("exact", 2.0, 5.0), ("punch", 1.0, 3.0), ("ring", 0.5, 2.0),
                           ("pressure:3", 4.5, 10.0), ("pressure:7", 8.5, 18.0)):
        for r in (low * (1 + 1e-5), (low + high) / 2, high * (1 - 1e-5)):
            k = double(mp.exp(RaySystem(law, mpf(r)).end(mpf(0))))
            points.append((law, 1.0, r, 1.0, 1.0, [k, k * (1 + 1e-9), 3 * k]))
    return points


def table_rays():
    """Stop times on and beside invariant rays, and where one is born."""
    yield ["law", "chi", "gamma", "mu", "u0", "v0", "v0_hex", "k_star", "tau_stop", "digits"]
    for law, chi, gamma, mu, u0, speeds in ray_points():
        r = mpf(gamma) * mpf(mu) ** 2 / mpf(chi)
        w = mpf(mu) * mpf(u0)
        kappa = 3 * mp.pi / (2 * mpf(chi))
        ratios = [mpf(speed) / w for speed in speeds]
        with mp.workdps(PRINTED + 60):                      # D keeps the digits of a number 1e-42 from the ray
            system = RaySystem(law, r)
            ends = [mp.exp(system.end(mp.log(k0))) for k0 in ratios]
            first = [system.by_orbit(k0, end) for k0, end in zip(ratios, ends)]
        with mp.workdps(PRINTED + 20):
            system = RaySystem(law, r)
            ways = {}
            for k0 in ratios:
                end = mp.exp(system.end(mp.log(k0)))
                ways.setdefault((mp.nstr(end, 20), k0 > end), (end, []))[1].append(k0)
            second = {}
            for end, starts in ways.values():
                second.update(system.by_regular_solution(starts, end))
        for speed, k0, end, sigma in zip(speeds, ratios, ends, first):
            digits = check([(kappa * w * sigma, kappa * w * second[k0])],
                           "rays %s gamma=%s u0=%s v0=%s" % (law, gamma, u0, speed))
            yield ([law, repr(chi), repr(gamma), repr(mu), repr(u0)] + exact(speed)
                   + [text(end), text(kappa * w * sigma), digits])


TABLES = {
    "laws": table_laws,
    "laws_pressure": table_laws_pressure,
    "stop_pade": lambda: stop_table("pade", stop_points(10, 27, EXTREMES)),
    "stop_hertz": lambda: stop_table("hertz", stop_points(5, 11, HERTZ_EXTREMES)),
    "trajectory_pade": lambda: trajectory_table("pade", trajectory_points()),
    "trajectory_hertz": lambda: trajectory_table("hertz", trajectory_points()),
    "bodies": table_bodies,
    "rays": table_rays,
}


def write(name, folder):
    """Write one table; nothing is left behind when the two ways disagree."""
    start = time.time()
    rows = []
    for row in TABLES[name]():
        rows.append(row)
        if sys.stderr.isatty():
            sys.stderr.write("\r%s: %d rows, %.0f s" % (name, len(rows) - 1, time.time() - start))
    with open(os.path.join(folder, name + ".csv"), "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    digits = [row[-1] for row in rows[1:]]
    sys.stderr.write("%s%s: %d rows, %d..%d digits agree, %.0f s\n" % (
        "\r" if sys.stderr.isatty() else "", name, len(digits), min(digits), max(digits),
        time.time() - start))


def main():
    """Command line."""
    global PRINTED
    parser = argparse.ArgumentParser(description="Write the many-digit reference tables.")
    parser.add_argument("--only", metavar="TABLE", action="append", choices=sorted(TABLES),
                        help="write only this table (may be repeated): " + ", ".join(TABLES))
    parser.add_argument("--digits", type=int, default=PRINTED,
                        help="significant digits to print (default %(default)s)")
    parser.add_argument("--output", default=os.path.dirname(os.path.abspath(__file__)),
                        help="folder to write to (default: the folder of this file)")
    arguments = parser.parse_args()
    PRINTED = arguments.digits
    mp.dps = PRINTED + GUARD
    for name in TABLES:
        if not arguments.only or name in arguments.only:
            write(name, arguments.output)


if __name__ == "__main__":
    main()
