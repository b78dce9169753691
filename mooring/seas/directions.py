"""Distribution over direction of a measured spectrum, from buoy data at each frequency: moments, or a mean and a
spread.

    D(α) = (1/2π) (1 − φ₁ c₁* − φ₂ c₂*) / |1 − φ₁ e^{−iα} − φ₂ e^{−2iα}|²
    φ₁ = (c₁ − c₂ c₁*) / (1 − |c₁|²),   φ₂ = c₂ − φ₁ c₁,   c₁ = r₁ e^{iα₁},   c₂ = r₂ e^{2iα₂}

has the moments c₁, c₂ = ∫ D e^{iα} dα, ∫ D e^{2iα} dα and, unlike their Fourier sum, is nowhere negative (Lygre and
Krogstad 1986, Journal of Physical Oceanography 16).  If only the spread σ is known, D is cos²ˢ{(α − α₁)/2}, s = 2/σ²
− 1 (Kuik et al. 1988). Angles α are directions that waves come from, clockwise from north.
"""

import numpy as np

ROWS = 180  # directions
ALPHA = np.arange(ROWS) * (2 * np.pi / ROWS)  # rad
LARGEST_S = 2000.0  # 1.3° of spread, less than a row
LARGEST = 0.99  # largest r₁ and r₂; beyond, D is narrower than a row


def of_moments(r1, r2, alpha1, alpha2):
    """Density over direction, 1/rad, on ALPHA; shape (n, ROWS); r1, r2 : (n,); alpha1, alpha2 : (n,), rad. The
    density is uniform where a value is NaN (unknown)
    """
    r1, r2 = np.clip(r1, 0, LARGEST), np.clip(r2, 0, LARGEST)
    c1, c2 = r1 * np.exp(1j * alpha1), r2 * np.exp(2j * alpha2)
    with np.errstate(invalid="ignore"):  # division by NaN, where the direction is unknown
        p1 = (c1 - c2 * c1.conj()) / (1 - np.abs(c1) ** 2)
    p2 = c2 - p1 * c1
    turn = np.exp(-1j * ALPHA)
    below = np.abs(1 - p1[:, None] * turn - p2[:, None] * turn**2) ** 2
    return _whole((1 - p1 * c1.conj() - p2 * c2.conj()).real[:, None] / below)


def of_spread(alpha1, spread):
    """Density over direction, 1/rad, on ALPHA; shape (n, ROWS); alpha1, spread : (n,), rad. The density is uniform
    where a value is NaN (unknown)
    """
    s = np.clip(2 / np.maximum(spread, 1e-3) ** 2 - 1, 0, LARGEST_S)
    with np.errstate(divide="ignore"):
        return _whole(np.exp(2 * s[:, None] * np.log(np.abs(np.cos((ALPHA - alpha1[:, None]) / 2)))))


def towards(x_axis):
    """Direction of travel, rad, of waves that come from ALPHA, in axes whose x points to x_axis compass degrees;
    shape (ROWS,)
    """
    return np.radians(x_axis) - ALPHA - np.pi


def _whole(values):
    """Rows of integral one; uniform where a row is unknown or negative, as for impossible moments"""
    bad = ~np.all(np.isfinite(values) & (values >= 0), axis=1)
    values = np.where(bad[:, None], 1.0, values)
    return values / (values.sum(axis=1, keepdims=True) * (2 * np.pi / ROWS))
