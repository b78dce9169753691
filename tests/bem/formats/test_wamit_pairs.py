"""Forces of pairs in WAMIT's .12d and .12s: what a file says by its manual, and back to the printed digits."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.formats.values import FormatError
from hakobune.bem.formats.wamit_pairs import read_pairs, write_pairs
from hakobune.bem.modes import Body
from hakobune.bem.second_order.kinds import SUM
from hakobune.bem.second_order.quadratic_forces import QuadraticForces

WEIGHT = 1025 * 9.80665


@pytest.fixture
def forces():
    rng, omega, headings = np.random.default_rng(2), np.linspace(0.5, 0.9, 5), np.radians([0.0, 30.0])
    T = 1e5 * (rng.normal(size=(3, 5, 2, 2, 6)) + 1j * rng.normal(size=(3, 5, 2, 2, 6)))
    T[0] = T[0] + T[0].swapaxes(1, 2).conj()
    T[np.arange(3)[:, None] + np.arange(5) > 4] = np.nan
    return QuadraticForces(omega, 0.1 * np.arange(3), headings, T, 0.5 * T, 0 * T)


def test_a_line_has_both_periods_both_headings_and_the_conjugate_force_over_the_weight(forces, tmp_path):
    path = write_pairs(forces, tmp_path / "box.1", WEIGHT)
    rows = np.loadtxt(path)
    periods = 2 * np.pi / (forces.omega[2] + 0.1), 2 * np.pi / forces.omega[2]
    row = rows[np.all(np.isclose(rows[:, :5], [*periods, 30.0, 0.0, 1], rtol=1e-6), axis=1)][0]
    T = forces.total[1, 2, 1, 0, 0].conj() / WEIGHT
    assert row[5:] == pytest.approx([abs(T), np.degrees(np.angle(T)), T.real, T.imag], rel=1e-6)


def test_what_is_written_is_read_to_the_printed_digits(forces, tmp_path):
    write_pairs(forces, tmp_path / "box.1", WEIGHT)
    found = read_pairs(tmp_path / "box.1", WEIGHT)
    np.testing.assert_allclose(found.total, forces.total, rtol=1e-5, atol=1)
    np.testing.assert_allclose(found.omega, forces.omega, rtol=1e-6)


def test_pairs_of_several_bodies_are_along_the_axes_of_the_scene_and_numbered_through(forces, tmp_path):
    """Of a body that heads along y, what is along its own x is along y of the scene, and minus x along its own y"""
    bodies = (Body("one"), Body("two", heading=np.pi / 2))
    parts = {part: np.concatenate([getattr(forces, part), 2 * getattr(forces, part)], axis=-1)
             for part in ("squares", "bound_wave", "body")}  # fmt: skip
    write_pairs(replace(forces, **parts), tmp_path / "box.1", WEIGHT, bodies)
    total = read_pairs(tmp_path / "box.1", WEIGHT).total
    assert total.shape[-1] == 12
    np.testing.assert_allclose(total[..., :6], forces.total, rtol=1e-5, atol=1)
    turned = 2 * forces.total[..., [1, 0, 2, 4, 3, 5]] * [-1, 1, 1, -1, 1, 1]
    np.testing.assert_allclose(total[..., 6:], turned, rtol=1e-5, atol=1)
    metres = read_pairs(tmp_path / "box.1", WEIGHT, length=2.0).total  # ULEN
    np.testing.assert_allclose(metres, total * np.tile([2, 2, 2, 4, 4, 4], 2))


def test_pairs_of_the_other_order_say_the_same_and_missing_ones_are_named(forces, tmp_path):
    path = write_pairs(forces, tmp_path / "box.1", WEIGHT)
    rows = np.loadtxt(path)
    swapped = rows[:, [1, 0, 3, 2, 4, 5, 6, 7, 8]] * [1, 1, 1, 1, 1, 1, -1, 1, -1]
    np.savetxt(path, swapped, fmt="%.9e")
    np.testing.assert_allclose(read_pairs(path, WEIGHT).total, forces.total, rtol=1e-5, atol=1)
    np.savetxt(path, rows[:-6], fmt="%.9e")
    with pytest.raises(FormatError, match=r"lacks pairs of frequencies 0.2 rad/s apart"):
        read_pairs(path, WEIGHT)
    assert read_pairs(tmp_path / "other.1", WEIGHT) is None


@pytest.fixture
def sums():
    """Of five frequencies up to the sum of the second and the last"""
    rng, omega, headings = np.random.default_rng(3), np.linspace(0.5, 0.9, 5), np.radians([0.0, 30.0])
    T = np.full((6, 5, 2, 2, 6), np.nan, complex)
    for row in range(6):
        higher, lower = SUM.pairs(row, 5)
        T[row, lower] = 1e5 * (rng.normal(size=(len(lower), 2, 2, 6)) + 1j * rng.normal(size=(len(lower), 2, 2, 6)))
        alike = lower[higher == lower]
        T[row, alike] += T[row, alike].swapaxes(1, 2)
    return QuadraticForces(omega, 1.0 + 0.1 * np.arange(6), headings, T, 0.5 * T, 0 * T, kind=SUM)


def test_sums_have_a_file_of_their_own_that_reads_back(sums, tmp_path):
    path = write_pairs(sums, tmp_path / "box.1", WEIGHT)
    rows = np.loadtxt(path)
    assert path.name == "box.12s" and np.all(rows[:, 0] <= rows[:, 1] * (1 + 1e-9))
    row = rows[np.all(np.isclose(rows[:, :5], [2 * np.pi / 0.8, 2 * np.pi / 0.6, 30.0, 0.0, 3], rtol=1e-6), axis=1)][0]
    assert row[7] - 1j * row[8] == pytest.approx(sums.total[4, 1, 1, 0, 2] / WEIGHT, rel=1e-6)
    found = read_pairs(path, WEIGHT, SUM)
    np.testing.assert_allclose(found.total, sums.total, rtol=1e-5, atol=1)
    np.testing.assert_allclose(found.frequency, sums.frequency, rtol=1e-6)
    assert found.kind is SUM and read_pairs(path, WEIGHT) is None


def test_sums_of_the_other_order_say_the_same_and_missing_ones_are_named(sums, tmp_path):
    path = write_pairs(sums, tmp_path / "box.1", WEIGHT)
    rows = np.loadtxt(path)
    np.savetxt(path, rows[:, [1, 0, 3, 2, 4, 5, 6, 7, 8]], fmt="%.9e")
    np.testing.assert_allclose(read_pairs(path, WEIGHT, SUM).total, sums.total, rtol=1e-5, atol=1)
    once = rows[(rows[:, 0] != rows[:, 1]) | (rows[:, 2] <= rows[:, 3])]  # of one frequency, its headings in one order
    np.savetxt(path, once, fmt="%.9e")
    assert len(once) < len(rows)
    np.testing.assert_allclose(read_pairs(path, WEIGHT, SUM).total, sums.total, rtol=1e-5, atol=1)
    np.savetxt(path, rows[:-6], fmt="%.9e")
    with pytest.raises(FormatError, match=r"lacks pairs of frequencies whose sum is 1.5 rad/s"):
        read_pairs(path, WEIGHT, SUM)
