"""Random scenes: boxes and buoys in any depth, in waves of any length.

depth/draft 1.005 … ∞, kh 1e-4 … 200 (in infinite depth k·draft 1e-4 … 20), B/d and R/d 0.2 … 100, L/B 1 … 20, drawn
evenly in the logarithm, a twentieth of the draws at either end.  A third of the frequencies lies on or beside an
irregular frequency: with φ = 0 or the walls' resonances of the water inside the hull,

    K = κ coth κd    where the panel method's equations have a false resonance (interior of the hull),
    k = κ            where those of the contour method have one (interior of the plan),

κ² = π²(m²/L² + n²/B²) for the box, Jₘ(κR) = 0 for the buoy.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from hakobune.bem.waves import wavenumber

GRAVITY = 9.80665
DRAFTS, GAPS, WIDTHS, SLENDERNESS = (1, 20), (0.005, 200), (0.2, 100), (1, 20)
WAVES, DEEP_WAVES = (1e-4, 200), (1e-4, 20)
AT_END, DEEP, ROUND, IRREGULAR, ON_PLANE = 0.05, 0.1, 0.3, 1 / 3, 0.5  # shares of the draws
BESIDE = (1e-7, 0.02)  # how far from an irregular frequency, relative
FIRST = 10  # irregular frequencies of a body


@dataclass(frozen=True)
class StressScene:
    """One body in one wave.

    number : number with which the scene was drawn; sizes : {name: m} of the shape without the draft; draft, depth : m
    omega : rad/s; headings : degrees, the first on a plane of symmetry in every second scene
    """

    number: int
    shape: str
    sizes: dict
    draft: float
    depth: float
    omega: float
    headings: tuple

    @property
    def k(self):
        """Wavenumber, rad/m"""
        return float(wavenumber(self.omega, self.depth, GRAVITY))

    @property
    def reach(self):
        """m, largest distance of the hull from its axis"""
        return float(np.hypot(*self.sizes.values()) / 2) if self.shape == "box" else self.sizes["radius"]

    def command(self, method="auto", tolerance=0.01):
        """The command line that solves the scene again"""
        sizes = " ".join(f"--{name} {value!r}" for name, value in {**self.sizes, "draft": self.draft}.items())
        headings = ",".join(f"{h:g}" for h in self.headings)
        return (
            f"hakobune {self.shape} {sizes} --depth {self.depth!r} --omega {self.omega!r} --heading={headings} "
            f"--tolerance {tolerance:g} --method {method} --output scene_{self.number}.h5"
        )

    def tables(self, method="auto", tolerance=0.01):
        """Nested dictionaries as a scene file has them"""
        return {
            "water": {"depth": self.depth, "gravity": GRAVITY},
            "bodies": [{"shape": self.shape, "draft": self.draft, **self.sizes}],
            "waves": {"omegas": [self.omega], "headings_deg": list(self.headings)},
            "method": method,
            "tolerance": tolerance,
        }

    def neighbours(self, step):
        """Return (name, the scenes on both sides) for every parameter moved by ± `step`, relative; headings in rad"""
        gap, turn = self.depth - self.draft, math.degrees(step)
        yield "omega", [replace(self, omega=self.omega * (1 + s)) for s in (-step, step)]
        drafts = [self.draft * (1 + s) for s in (-step, step)]
        yield "draft", [replace(self, draft=draft, depth=draft + gap) for draft in drafts]
        if math.isfinite(self.depth):
            yield "gap", [replace(self, depth=self.draft + gap * (1 + s)) for s in (-step, step)]
        for name, value in self.sizes.items():
            yield name, [replace(self, sizes={**self.sizes, name: value * (1 + s)}) for s in (-step, step)]
        yield "heading", [replace(self, headings=tuple(h + s for h in self.headings)) for s in (-turn, turn)]


def drawn(seed, number):
    """The `StressScene` of a seed and a number, which depends on no other scene"""
    rng = np.random.default_rng([seed, number])
    draft = _rounded(_even(rng, *DRAFTS))
    width = _with_ends(rng, *WIDTHS) * draft
    if rng.random() < ROUND:
        shape, sizes = "buoy", {"radius": _rounded(width)}
    else:
        shape, sizes = "box", {"length": _rounded(width * _with_ends(rng, *SLENDERNESS)), "beam": _rounded(width)}
    deep = rng.random() < DEEP
    depth = math.inf if deep else _rounded(draft * (1 + _with_ends(rng, *GAPS)))
    omega = _frequency(rng, shape, sizes, draft, depth)
    return StressScene(number, shape, sizes, draft, depth, _rounded(omega, 10), _headings(rng))


def irregular(shape, sizes, draft, depth):
    """The lowest κ (FIRST,) rad/m of the interior of a plan, and ω (2, FIRST) rad/s of hull and plan"""
    eigenvalues = _box_eigenvalues if shape == "box" else _round_eigenvalues
    kappa = np.sort(eigenvalues(*sizes.values()))[:FIRST]
    plan = GRAVITY * kappa * (1.0 if math.isinf(depth) else np.tanh(kappa * depth))
    return kappa, np.sqrt([GRAVITY * kappa / np.tanh(kappa * draft), plan])


def _box_eigenvalues(length, beam):
    m = np.arange(1, 41)
    return np.pi * np.hypot.outer(m / length, m / beam).ravel()


def _round_eigenvalues(radius):
    from scipy.special import jn_zeros

    return np.concatenate([jn_zeros(m, 5) for m in range(8)]) / radius


def _frequency(rng, shape, sizes, draft, depth):
    deep = math.isinf(depth)
    k = _with_ends(rng, *DEEP_WAVES) / draft if deep else _with_ends(rng, *WAVES) / depth
    if rng.random() < IRREGULAR:
        beside = rng.choice([-1, 0, 1]) * _even(rng, *BESIDE)
        omega = irregular(shape, sizes, draft, depth)[1][rng.integers(2), rng.integers(FIRST)] * (1 + beside)
        if wavenumber(omega, depth, GRAVITY) * (draft if deep else depth) <= (DEEP_WAVES if deep else WAVES)[1]:
            return float(omega)
    return math.sqrt(GRAVITY * k * (1.0 if deep else math.tanh(k * depth)))


def _headings(rng):
    """Two, the first on a plane of symmetry in every second scene"""
    first = float(rng.choice([0, 90, 180, 270])) if rng.random() < ON_PLANE else round(rng.uniform(0, 360), 3)
    return tuple(round((heading + 180) % 360 - 180, 3) for heading in (first, first + rng.uniform(5, 355)))


def _even(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def _with_ends(rng, low, high):
    place = rng.random()
    return low if place < AT_END else high if place > 1 - AT_END else _even(rng, low, high)


def _rounded(value, digits=6):
    """Rounded to what is written in a command line"""
    return float(f"{value:.{digits}g}")
