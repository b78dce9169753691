"""Makes green_finite_depth.csv: the Green function of a source under a free surface to 40 digits, with mpmath.

Two forms that share nothing but the dispersion relation, h = 1 and g = 1 (Wehausen & Laitone 1960, eqs. 13.17-13.19):

integral (R ≤ 5):  G = 1/r + 1/r₂ + f(R, z+ζ+2h) + f(R, |z−ζ|) + residue
    f(R, V) = PV∫ (μ+K) e^(−μh) cosh μV / (μ sinh μh − K cosh μh) J₀(μR) dμ
    where 1/r₁ + 2KF, the same integral in infinite depth, is taken out of the first f and added in closed form:
    F(X, Y) = −π e^(−Y) Y₀(X) − ∫₀^∞ e^(−s) (X² + (Y−s)²)^(−½) ds
series (R ≥ 0.45; John 1950):  G = i C Z(z) Z(ζ) H₀(kR) + 4 Σ (k²+K²)/((k²+K²)h − K) cos k(z+h) cos k(ζ+h) K₀(kR)

Where both exist the integral is stored and must agree with the series to 1e-25 of |G| + 1e-30.  Needs mpmath, and
takes half an hour:  python tests/published/make_green.py
"""

import itertools
import random
from functools import cache
from pathlib import Path

import mpmath as mp

mp.mp.dps = 50
ORDER = 40  # Gauss nodes of a panel whose nearest pole is two half-widths from its middle: error 3.7^(−80)


@cache
def gauss():
    """Nodes and weights on (−1, 1)."""
    out = []
    for i in range(ORDER):
        x = mp.cos(mp.pi * (i + mp.mpf(3) / 4) / (ORDER + mp.mpf(1) / 2))
        for _ in range(8):
            p = [mp.mpf(1), x]
            for n in range(2, ORDER + 1):
                p.append(((2 * n - 1) * x * p[-1] - (n - 1) * p[-2]) / n)
            slope = ORDER * (x * p[-1] - p[-2]) / (x * x - 1)
            x -= p[-1] / slope
        out.append((x, 2 / ((1 - x * x) * slope**2)))
    return out


def nodes(breaks):
    for a, b in itertools.pairwise(breaks):
        for x, w in gauss():
            yield (a + b) / 2 + (b - a) / 2 * x, w * (b - a) / 2


def growing(a, b, first, widest):
    breaks, width = [a], first
    while breaks[-1] < b:
        breaks.append(min(breaks[-1] + width, b))
        width = min(2 * width, widest)
    return breaks


def around(pole, end, widest):
    """Breaks from 0 to end with a panel whose middle is the pole, so that its Gauss sum is the principal value."""
    half = min(pole, widest / 2)
    left = [pole - b for b in growing(half, pole, 2 * half, widest)][::-1] if pole > half else [pole - half]
    return left[:-1] + growing(pole - half, pole + half, 2 * half, widest) + growing(pole + half, end, half, widest)[1:]


def wavenumber(K):
    k = mp.sqrt(K) if K < 1 else K
    for _ in range(60):
        t = mp.tanh(k)
        k -= (k * t - K) / (t + k * (1 - t * t))
    return k


def deep_water(X, Y):
    """F, ∂F/∂X, ∂F/∂Y."""
    with mp.workdps(100):
        low, far = -mp.asinh(Y / X), mp.mpf(250)
        high = mp.asinh((far - Y) / X)
        panels = int((high - low) / mp.mpf("0.25")) + 40  # at most a factor e^(-6) in each
        F = FX = mp.mpf(0)
        for u, w in nodes([low + (high - low) * i / panels for i in range(panels + 1)]):
            e = w * mp.exp(-(Y + X * mp.sinh(u)))
            F -= e
            FX += e / (X * mp.cosh(u) ** 2)
        F -= mp.pi * mp.exp(-Y) * mp.bessely(0, X)
        FX += mp.pi * mp.exp(-Y) * mp.bessely(1, X)
        return F, FX, -F - 1 / mp.sqrt(X * X + Y * Y)


def fraction(mu, K):
    """(μ+K) / ((μ−K) − (μ+K) e^(−2μ))"""
    return (mu + K) / (-mu * mp.expm1(-2 * mu) - K * (1 + mp.exp(-2 * mu)))


def bessel(mu, R):
    return mp.besselj(0, mu * R), -mu * mp.besselj(1, mu * R)


def total(terms):
    sums = [mp.mpf(0)] * 3
    for even, odd, (j0, j1) in terms:
        sums = [sums[0] + even * j0, sums[1] + even * j1, sums[2] + odd * j0]
    return sums


def bed(R, V, K, k):
    """f(R, V) and its derivatives, V ≤ 1."""
    far, widest = 100, min(mp.mpf(1), 3 / R)
    breaks = around(k, max(2 * k, far), widest) if k < far else growing(mp.mpf(0), far, widest, widest)

    def terms():
        for mu, w in nodes(breaks):
            a, up, down = w * fraction(mu, K), mp.exp(mu * (V - 2)), mp.exp(-mu * (V + 2))
            yield a * (up + down), a * mu * (up - down), bessel(mu, R)

    return total(terms())


def rest(R, Y, K, k):
    """f(R, 2−Y) − 1/r₁ − 2KF and its derivatives by R and Y."""
    far, widest = mp.mpf(50), min(mp.mpf(1), 3 / R)
    end = max(2 * k, 2 * K) if k < far else mp.mpf(0)

    def terms():
        if end:
            for mu, w in nodes(around(k, end, widest)):
                a, direct, image = w * fraction(mu, K), mp.exp(-mu * Y), mp.exp(mu * (Y - 4))
                yield a * (direct + image), -a * mu * (direct - image), bessel(mu, R)
            for mu, w in nodes(around(K, end, widest)):
                a = w * (mu + K) / (mu - K) * mp.exp(-mu * Y)
                yield -a, a * mu, bessel(mu, R)
        if end < far:
            for mu, w in nodes(growing(end, far, min(widest, end or widest), widest)):
                a, image = w * fraction(mu, K), mp.exp(mu * (Y - 4))
                direct = mp.exp(-mu * (Y + 2)) * (mu + K) / (mu - K)
                yield a * (direct + image), -a * mu * (direct - image), bessel(mu, R)

    return total(terms())


def inverse(R, v):
    r = mp.sqrt(R * R + v * v)
    return [1 / r, -R / r**3, -v / r**3]


def wave(R, z, zeta, K, k):
    """C Z(z) Z(ζ) and its derivative by z, times J₀ and −Y₀ by the caller."""
    C = 2 * mp.pi * k * k / (k * k - K * K + K)
    source = C * mp.cosh(k * (zeta + 1)) / mp.cosh(k) ** 2
    return source * mp.cosh(k * (z + 1)), source * k * mp.sinh(k * (z + 1))


def by_integral(R, z, zeta, K, k):
    Y, V = -(z + zeta), abs(z - zeta)
    up = 1 if z >= zeta else -1
    g = [a + b for a, b in zip(inverse(R, z - zeta), inverse(R, z + zeta + 2), strict=True)]
    g = [a + b for a, b in zip(g, inverse(R, z + zeta), strict=True)]
    for part, sign in ((infinite_part(R, Y, K), -1), (rest(R, Y, K, k), -1), (bed(R, V, K, k), up)):
        g = [g[0] + part[0], g[1] + part[1], g[2] + sign * part[2]]
    value, slope = wave(R, z, zeta, K, k)
    j0, j1 = bessel(k, R)
    return [mp.mpc(g[0], value * j0), mp.mpc(g[1], value * j1), mp.mpc(g[2], slope * j0)]


def infinite_part(R, Y, K):
    F, FX, FY = deep_water(K * R, K * Y)
    return 2 * K * F, 2 * K * K * FX, 2 * K * K * FY


@cache
def evanescent(K, count):
    out = []
    for m in range(1, count + 1):
        y = mp.atan(K / (m * mp.pi))
        for _ in range(80):  # (mπ − y) tan y = K
            t = mp.tan(y)
            y -= ((m * mp.pi - y) * t - K) / ((m * mp.pi - y) * (1 + t * t) - t)
        out.append(m * mp.pi - y)
        assert abs(out[-1] * mp.tan(out[-1]) + K) < mp.mpf(10) ** -38 * (1 + K) and (m - 0.5) < out[-1] / mp.pi <= m
    return out


def by_series(R, z, zeta, K, k):
    value, slope = wave(R, z, zeta, K, k)
    j0, y0, j1, y1 = mp.besselj(0, k * R), mp.bessely(0, k * R), mp.besselj(1, k * R), mp.bessely(1, k * R)
    g = [mp.mpc(-y0, j0) * value, mp.mpc(y1, -j1) * k * value, mp.mpc(-y0, j0) * slope]
    count = int(75 / (mp.pi * R)) + 2
    for q in evanescent(K, count):
        c = 4 * (q * q + K * K) / (q * q + K * K - K) * mp.cos(q * (zeta + 1))
        k0, k1 = mp.besselk(0, q * R), mp.besselk(1, q * R)
        up = mp.cos(q * (z + 1))
        g = [g[0] + c * up * k0, g[1] - c * up * q * k1, g[2] - c * q * mp.sin(q * (z + 1)) * k0]
    return g


def in_infinite_depth(R, z, zeta, K):
    Y = -(z + zeta)
    part = infinite_part(R, Y, K)
    one, two = inverse(R, z - zeta), inverse(R, z + zeta)
    g = [a + b + s * c for a, b, c, s in zip(one, two, part, (1, 1, -1), strict=True)]
    scale = 2 * mp.pi * K * mp.exp(-K * Y)
    j0, j1 = bessel(K, R)
    return [mp.mpc(g[0], scale * j0), mp.mpc(g[1], scale * j1), mp.mpc(g[2], scale * K * j0)]


DEPTHS = [
    (0.0, 0.0), (-1.0, -1.0), (-0.98, -0.96), (0.0, -1.0), (-0.1, -0.35), (-0.0001, -0.0002), (-0.5, -0.5),
    (-0.7, -0.05), (-0.25, 0.0), (-1.0, -0.4), (-0.03, -0.02),
]  # fmt: skip
KH = [1e-4, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0, 200.0]
FAR = [1e-3, 0.01, 0.05, 0.2, 0.31, 0.42, 0.49, 0.5, 0.51, 0.7, 0.98, 1.6, 3.3, 5.0, 11.0, 40.0, 200.0, 1000.0]


def points():
    """(depth, omega, R, z, zeta), all double precision"""
    count = 0
    for kh in KH:
        omega = float(mp.sqrt(kh * mp.tanh(kh)))
        for R in FAR:
            for _ in range(2):
                yield 1.0, omega, R, *DEPTHS[count % len(DEPTHS)]
                count += 1
    rng = random.Random(1)
    for _ in range(60):  # anywhere
        kh, R = 10 ** rng.uniform(-4, 2.3), 10 ** rng.uniform(-3, 1)
        yield 1.0, float(mp.sqrt(kh * mp.tanh(kh))), R, -rng.random(), -rng.random()
    for i in range(120):  # infinite depth
        Y = 0.0 if i % 6 == 0 else 10 ** rng.uniform(-5, 2.3)
        z = -Y * rng.random()
        yield float("inf"), 1.0, 10 ** rng.uniform(-6, 4), z, -(Y + z)


def main():
    path, worst = Path(__file__).with_name("green_finite_depth.csv"), mp.mpf(0)
    rows = []
    for depth, omega, *place in points():
        K = mp.mpf(omega) ** 2
        R, z, zeta = map(mp.mpf, place)
        if depth == float("inf"):
            g = in_infinite_depth(R, z, zeta, K)
        else:
            k = wavenumber(K)
            g = by_integral(R, z, zeta, K, k) if R <= 5 else by_series(R, z, zeta, K, k)
            if 0.45 <= R <= 5:
                other = by_series(R, z, zeta, K, k)
                error = max(abs(a - b) for a, b in zip(g, other, strict=True))
                worst = max(worst, error / (abs(g[0]) + mp.mpf(10) ** -5))
                assert error < mp.mpf(10) ** -25 * abs(g[0]) + mp.mpf(10) ** -30, (depth, omega, place, error)
        digits = [mp.nstr(part, 20) for value in g for part in (value.real, value.imag)]
        rows.append(",".join([repr(float(depth)), repr(omega), *map(repr, place), *digits]))
    head = f"""\
# Green function G of a source 1/r under a free surface, time factor exp(-i omega t), gravity 1; R horizontal distance,
# z field, zeta source; with its derivatives by R and z.  Made by make_green.py with mpmath at 50 digits: principal
# value integral plus residue for R <= 5, John's (1950) series beyond.  For 0.45 <= R <= 5 in finite depth both
# were computed and differ by less than {mp.nstr(worst, 2)} of |G| + 1e-5.
depth,omega,R,z,zeta,G_real,G_imag,G_R_real,G_R_imag,G_z_real,G_z_imag
"""
    path.write_text(head + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
