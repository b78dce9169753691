"""Difference forces in a database: read as written, kept while it grows, interpolated between pairs."""

import shutil

import h5py
import numpy as np
import pytest

from hakobune.bem.database import DatabaseError, extend, open_database
from hakobune.bem.database.integrity import DamagedError
from hakobune.bem.second_order.quadratic_forces import PARTS, QuadraticForces
from hakobune.bem.second_order.stored import BetweenPairs, Held, StoredForces, read_forces, write_forces
from hakobune.pipelines.cli import main

OMEGA, HEADINGS = np.linspace(0.5, 1.1, 13), np.array([0.3, 1.0])


def smooth(one, two):
    """(…, 6) Hermitian and smooth"""
    middle, apart = 0.5 * (one + two), one - two
    value = np.cos(3 * middle) + 1j * np.sin(2 * apart) * middle - apart**2
    return value[..., None] * np.arange(1, 7)


def made_up():
    place, low = np.arange(5)[:, None] + np.arange(13), OMEGA
    values = smooth(OMEGA[np.minimum(place, 12)], low)
    values[place > 12] = np.nan
    forces = np.repeat(np.repeat(values[:, :, None, None], 2, axis=2), 2, axis=3)
    return QuadraticForces(OMEGA, 0.05 * np.arange(5), HEADINGS, forces, 0.5 * forces, 0.0 * forces, 0.1 * forces)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    path = tmp_path_factory.mktemp("pairs") / "box.h5"
    words = "box --length 40 --beam 20 --draft 5 --depth 15 --panels 40 --omega 0.5,0.8 --heading 0 --only radiation"
    assert main([*words.split(), "--output", str(path)]) == 0
    return path


@pytest.fixture
def path(made, tmp_path):
    return shutil.copy(made, tmp_path / "box.h5")


def test_they_are_read_as_they_were_written_and_the_rest_stays(path):
    with pytest.raises(DatabaseError, match="hakobune qtf"):
        read_forces(open_database(path))
    before = open_database(path)["added_mass"]
    lines = np.diag(np.arange(6.0))
    write_forces(path, StoredForces(made_up(), Held(True, "moor.toml", lines), "contour", 0.1, asked=0.5))
    db = open_database(path)
    found = read_forces(db)
    assert (found.share, found.asked, found.method, found.errors, found.coarser) == (0.1, 0.5, "contour", None, None)
    assert found.held.same_as(Held(True, "moor.toml", lines)) and not found.held.same_as(Held(True, "moor.toml"))
    assert np.array_equal(db["added_mass"], before)
    for part in PARTS:
        np.testing.assert_array_equal(getattr(found.forces, part), getattr(made_up(), part))
    with h5py.File(path) as file:
        assert file["qtf/squares"].dims[1][0].name.endswith("qtf/omega") and file["qtf"].attrs["meaning"]


def test_they_stay_while_a_database_grows_and_are_replaced_whole(path):
    write_forces(path, StoredForces(made_up(), Held(True)))
    assert extend(path, omega=[0.6])
    assert np.array_equal(read_forces(open_database(path)).forces.omega, OMEGA)
    write_forces(path, StoredForces(made_up(), Held(False)))
    assert not read_forces(open_database(path)).held.floats


def test_damage_in_them_is_found(path):
    write_forces(path, StoredForces(made_up(), Held(True)))
    data = bytearray(path.read_bytes())
    place = data.find(made_up().squares[2, 3, 0, 0].tobytes())
    data[place + 3] ^= 1
    path.write_bytes(data)
    with pytest.raises(DamagedError, match="qtf/squares"):
        open_database(path)


def test_between_stored_pairs_a_smooth_force_is_met_and_the_other_order_is_the_conjugate():
    forces = made_up()
    between = BetweenPairs(OMEGA, forces.frequency, forces.squares[:, :, 0, 0])
    np.testing.assert_allclose(between(OMEGA[4:9], OMEGA[2:7]), smooth(OMEGA[4:9], OMEGA[2:7]), rtol=1e-12)
    one, two = np.array([0.81, 0.93]), np.array([0.74, 0.86])
    assert np.abs(between(one, two) - smooth(one, two)).max() < 1e-4
    np.testing.assert_allclose(between(two, one), between(one, two).conj())


def test_beyond_the_stored_pairs_the_end_values_hold():
    """By mean frequency within each difference, and by difference; fewer than four pairs are met by a polynomial"""
    forces = made_up()
    between = BetweenPairs(OMEGA, forces.frequency, forces.squares[:, :, 0, 0])
    values = forces.squares[:, :, 0, 0]
    assert between(0.3, 0.3) == pytest.approx(values[0, 0]) and between(1.7, 1.7) == pytest.approx(values[0, -1])
    assert between(0.42, 0.32) == pytest.approx(values[2, 0]) and between(1.5, 1.4) == pytest.approx(values[2, -3])
    assert between(1.2, 0.4) == pytest.approx(between(0.9, 0.7))  # the last difference, of the same mean
    few = BetweenPairs(OMEGA[:3], forces.frequency[:2], forces.squares[:2, :3, 0, 0])
    apart = OMEGA[:3] + np.array([0.02, 0.0, -0.02])
    parabola = np.polynomial.polynomial.Polynomial.fit(OMEGA[:3], forces.squares[0, :3, 0, 0, 0], 2)
    assert few(apart, apart)[:, 0] == pytest.approx(parabola(apart))
    first, second = forces.squares[1, :2, 0, 0, 0]  # at the means 0.525 and 0.575
    assert few(0.56, 0.54)[0] == pytest.approx(0.6 * parabola(0.55) + 0.4 * (0.5 * first + 0.5 * second))
    assert few(0.6, 0.58)[0] == pytest.approx(0.6 * parabola(0.59) + 0.4 * second)
