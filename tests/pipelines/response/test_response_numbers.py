"""What `hakobune response` prints of a box in a head sea, from stored motions and drift by sums of text-books."""

import h5py
import numpy as np
import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.results.file import read

KEYS = [
    "sigma",
    "significant",
    "expected_maximum",
    "not_exceeded",
    "zero_crossing_period",
    "period_between_peaks",
    "bandwidth",
]
HEIGHT, PERIOD, HOURS = 3.0, 11.0, 2.0
STUDY = f"""
[sea]
height = {HEIGHT}
mean_period = {PERIOD}
direction_deg = 0.0
duration_hours = {HOURS}
"""
BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --method contour --gyration 15.55,29.44,32.28 --heading 0,20"


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Result of the command's file, and the file of the database"""
    folder = tmp_path_factory.mktemp("numbers")
    database = folder / "box.h5"
    assert main([*BOX.split(), "--omega", "0.2:1.7:61", "--output", str(database)]) == 0
    (folder / "study.toml").write_text(STUDY)
    words = ["--database", str(database), "--output", str(folder / "response.h5")]
    assert main(["response", str(folder / "study.toml"), *words]) == 0
    return read(folder / "response.h5", "response"), database


@pytest.fixture(scope="module")
def stored(found):
    """ω, |X|² of heave and pitch, D_x, and S by hand: 0.11/0.44 of the ISSC spectrum, with 4√m₀ the height"""
    with h5py.File(found[1]) as file:
        omega, rao, drift = file["omega"][()], file["rao"][()][:, 0], file["drift_force"][()][:, 0]
    B = 0.44 * (2 * np.pi / PERIOD) ** 4
    S = 4 * B * HEIGHT**2 / 16 * omega**-5 * np.exp(-B * omega**-4)
    return omega, np.abs(rao) ** 2, drift[:, 0], S


@pytest.mark.parametrize("name, place", [("surge", 0), ("heave", 2), ("pitch", 4)])
def test_motions_are_the_integrals_of_their_spectra(name, place, found, stored):
    """m_n = ∫ ωⁿ |X|² S dω: σ, T_zero = 2π√(m₀/m₂), T_peak = 2π√(m₂/m₄), ε² = 1 − m₂²/m₀m₄; of N = T/T_zero waves the
    largest σ(√(2 ln N) + γ/√(2 ln N)), and with 90 % below σ √(2 ln(N/−ln 0.9)); the highest third for ε → 0 2σ"""
    omega, squares, _, S = stored
    m0, m2, m4 = (np.trapezoid(omega**n * squares[:, place] * S, omega) for n in (0, 2, 4))
    sigma, waves = np.sqrt(m0), 3600 * HOURS / (2 * np.pi * np.sqrt(m0 / m2))
    root, epsilon = np.sqrt(2 * np.log(waves)), np.sqrt(1 - m2**2 / (m0 * m4))
    axis = [label.lower() for label in found[0].labels["response"].values]
    row = {key: found[0][f"response.{key}"][axis.index(name)] for key in KEYS}
    assert row["sigma"] == pytest.approx(sigma, rel=0.01)
    assert row["zero_crossing_period"] == pytest.approx(2 * np.pi * np.sqrt(m0 / m2), rel=0.01)
    assert row["period_between_peaks"] == pytest.approx(2 * np.pi * np.sqrt(m2 / m4), rel=0.01)
    assert row["bandwidth"] == pytest.approx(epsilon, abs=0.01)
    assert row["expected_maximum"] == pytest.approx(sigma * (root + 0.5772 / root), rel=0.012)
    assert row["not_exceeded"] == pytest.approx(sigma * np.sqrt(2 * np.log(waves / -np.log(0.9))), rel=0.012)
    # maxima of bandwidth ε by a sum over their density (Cartwright & Longuet-Higgins 1956, eq. 4.8)
    eta = np.linspace(-5, 8, 60001)
    tail = np.cumsum(np.exp(-0.5 * np.linspace(-60, 60, 240001) ** 2)) * 0.0005 / np.sqrt(2 * np.pi)
    below = np.interp(eta * np.sqrt(1 - epsilon**2) / epsilon, np.linspace(-60, 60, 240001), tail)
    density = epsilon / np.sqrt(2 * np.pi) * np.exp(-0.5 * (eta / epsilon) ** 2)
    density += np.sqrt(1 - epsilon**2) * eta * np.exp(-0.5 * eta**2) * below
    above = np.cumsum(density[::-1])[::-1] * (eta[1] - eta[0])
    third = above < 1 / 3
    assert row["significant"] == pytest.approx(
        sigma * np.sum((eta * density)[third]) / np.sum(density[third]), rel=0.015
    )


def test_mean_and_slow_drift_are_those_of_pinkster_and_newman(found, stored):
    """F̄ = 2 ∫ D S dω (Maruo 1960), and σ² = 8 ∬ D D′ S S′ over pairs of frequencies up to Δ apart, each pair once
    (Pinkster 1980 with Newman's diagonal)"""
    omega, _, D, S = stored
    assert found[0]["drift[surge].mean"] == pytest.approx(2 * np.trapezoid(D * S, omega), rel=0.01)
    most, sigma = found[0].labels["difference"].values[-1], found[0]["drift[surge].sigma"]
    fine = np.linspace(omega[0], omega[-1], 3001)
    one = np.interp(fine, omega, D * S)
    apart = fine[None] - fine[:, None]
    step = fine[1] - fine[0]
    by_hand = np.sqrt(8 * step**2 * np.sum(np.outer(one, one)[(apart > 0) & (apart <= most)]))
    assert sigma == pytest.approx(by_hand, rel=0.02)
