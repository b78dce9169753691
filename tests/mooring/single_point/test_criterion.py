"""The criterion of slewing against the linear equations it is derived from, and the report's table."""

import csv
from pathlib import Path

import numpy as np
import pytest

from hakobune.mooring.single_point.criterion import (
    Lateral,
    Proportions,
    discriminant,
    moored_quartic,
    proportions,
    roots,
    routh_hurwitz,
    undamped,
    undamped_stable,
)

INPUTS = ("my_nd", "Iz_nd", "xi", "zeta", "Cx", "dCY_dpsi", "dCN_dpsi")
COLUMNS = ("i", "ii", "i_minus_ii", "iii", "iv", "iii_x_iv", "disc")
PUBLISHED = Path(__file__).parents[2] / "published" / "slewing_discriminant.csv"


def rows():
    lines = [line for line in PUBLISHED.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def random_lateral(rng):
    signs = rng.choice([-1.0, 1.0], 4)
    return Lateral(
        *10 ** rng.uniform([7, 9], [8, 11]), 10 ** rng.uniform(4, 6), rng.uniform(20, 120), rng.uniform(5, 300),
        -(10 ** rng.uniform(4, 6)), signs[0] * 10 ** rng.uniform(5, 7), signs[1] * 10 ** rng.uniform(4, 6),
        signs[2] * 10 ** rng.uniform(5, 7), -(10 ** rng.uniform(8, 10)), signs[3] * 10 ** rng.uniform(6, 8),
    )  # fmt: skip


def linear_equations(m):
    """(4, 4) of (y, ψ, ẏ, ψ̇) as forces and moments act, in axes that do not turn"""
    K, B = np.zeros((2, 2)), np.zeros((2, 2))
    pull_y, pull_psi = -m.pull / m.length, -m.pull * (m.arm / m.length + 1)
    K[0], K[1] = (pull_y, pull_psi), (m.arm * pull_y, m.arm * pull_psi)
    K[:, 1] += m.Y_psi, m.N_psi
    B[0], B[1] = (m.Y_v, m.Y_r), (m.N_v, m.N_r)
    M = np.diag([m.mass, m.inertia])
    return np.block([[np.zeros((2, 2)), np.eye(2)], [np.linalg.solve(M, K), np.linalg.solve(M, B)]])


def test_the_quartic_is_the_characteristic_polynomial_of_the_linear_equations():
    """Determinants at points off the axis, where no root is hit"""
    rng = np.random.default_rng(1)
    for _ in range(200):
        m = random_lateral(rng)
        quartic, J = moored_quartic(m), linear_equations(m)
        for point in rng.uniform(0.5, 2.0, 3) * np.sqrt(np.abs(np.linalg.eigvals(J)).max()):
            wanted = np.linalg.det(point * np.eye(4) - J)
            assert abs(np.polyval(quartic, point) / wanted - 1) < 1e-9


def test_routh_and_hurwitz_agree_with_the_roots():
    rng = np.random.default_rng(2)
    quartics = np.stack([moored_quartic(random_lateral(rng)) for _ in range(2000)])
    growth = roots(quartics)[:, 0].real
    sure = np.abs(growth) > 1e-9
    assert 0.1 < np.mean(routh_hurwitz(quartics)) < 0.9
    assert np.array_equal(routh_hurwitz(quartics)[sure], (growth < 0)[sure])


def test_the_undamped_motion_is_bounded_where_its_roots_lie_on_the_imaginary_axis():
    rng = np.random.default_rng(3)
    quartics = undamped(np.stack([moored_quartic(random_lateral(rng)) for _ in range(2000)]))
    bounded = np.abs(roots(quartics).real).max(axis=-1) < 1e-9 * np.abs(roots(quartics)).max(axis=-1) ** 0.5
    assert np.mean(undamped_stable(quartics) == bounded) > 0.999


def test_the_proportions_are_those_of_the_undamped_quartic():
    """B and B² − 4D of the moored quartic, made dimensionless by ξ I m (L/V)²"""
    rng = np.random.default_rng(4)
    m = random_lateral(rng)._replace(Y_v=0.0, Y_r=0.0, N_v=0.0, N_r=0.0)
    L, d, V, rho = 180.0, 9.0, 0.7, 1025.0
    p = proportions(m, L, d, V, rho)
    found, (_, _, B, _, D) = discriminant(p), moored_quartic(m)
    scale = p.length * p.inertia * p.mass * (L / V) ** 2
    assert abs(found.B / (B * scale) - 1) < 1e-12
    assert abs(found.value / ((B * B - 4 * D) * scale**2) - 1) < 1e-9


def printed(row, name):
    """Value and half a unit of its last printed digit"""
    text = row[name]
    return float(text), 0.5 * 10.0 ** -len(text.partition(".")[2])


def columns(given):
    """The printed columns of table 3.6.4.1 from its inputs (7,)"""
    d = discriminant(Proportions(*given))
    return np.array([d.i, d.ii, d.B, d.iii, d.iv, d.iii * d.iv, d.value]), d.stable


@pytest.mark.parametrize("row", rows(), ids=lambda row: row["hull"])
def test_table_3_6_4_1_is_met_to_its_printed_digits(row):
    """To half a unit of the last digit, and what the rounding of the printed inputs leaves open"""
    given, half = np.transpose(
        [printed(row, n) for n in ("my_nd", "Iz_nd", "xi", "zeta", "Cx", "dCY_dpsi", "dCN_dpsi")]
    )
    wanted, digit = np.transpose([printed(row, f"print_{n}") for n in COLUMNS])
    found, stable = columns(given)
    left_open = sum(np.abs(columns(given + step)[0] - found) for step in np.diag(half))
    assert np.all(np.abs(found - wanted) <= digit * (1 + 1e-9) + left_open), (found, wanted)
    assert np.all(np.abs(found - wanted) < 2.01 * digit), (found, wanted)
    assert stable == (row["verdict"] == "stable")
