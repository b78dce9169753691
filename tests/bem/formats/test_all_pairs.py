"""From any format to any other and back: what both have places for is the same within the digits of the files."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from hakobune.bem.formats import bemio, capytaine, hams, nemoh, orcaflex, wamit
from hakobune.bem.formats.values import Values, about

RHO, G = 1025.0, 9.80665
WATER = {"water_depth": 20.0, "density": RHO, "gravity": G}
PLACES = {wamit: "a.1", nemoh: "a_nemoh", hams: "a_hams", bemio: "a_bemio.h5", capytaine: "a.nc", orcaflex: "a.yml"}


@pytest.fixture(scope="module")
def values():
    """Numbers of no body, without any symmetry but Z = Zᵀ, about a point beside the origin"""
    random = np.random.default_rng(3)
    omega, beta = np.array([0.5, 0.75, 1.0]), np.radians([0.0, 45.0, 90.0])

    def matrices(n):
        half = random.normal(size=(n, 6, 6)) * 1e5
        return half + half.swapaxes(1, 2) + 4e5 * np.eye(6)

    X = random.normal(size=(3, 3, 6)) + 1j * random.normal(size=(3, 3, 6))
    quantities = {"added_mass": matrices(3), "radiation_damping": matrices(3), "excitation_force": 1e5 * X,
                  "added_mass_infinity": matrices(1)[0]}  # fmt: skip
    stiffness = np.zeros((6, 6))
    stiffness[2:5, 2:5] = matrices(1)[0][:3, :3]
    center = np.array([0.5, 0.0, -1.0])
    inertia = np.zeros((6, 6))
    inertia[:3, :3], inertia[3:, 3:] = 8e5 * np.eye(3), np.diag([3e7, 5e7, 6e7])
    body = {"mass": 8e5, "center_of_mass": center, "inertia_matrix": inertia, "hydrostatic_stiffness": stiffness,
            "displaced_volume": 780.0, "center_of_buoyancy": np.array([0.5, 0.0, -2.0])}  # fmt: skip
    return Values(omega, beta, 20.0, RHO, G, quantities, body, center, name="a")


def passed(values, module, folder):
    place = folder / PLACES[module]
    module.write(values, place)
    known = WATER | {"rotation_center": tuple(values.rotation_center)} if module in (wamit, hams) else WATER
    return module.read(place, known)


@pytest.mark.parametrize("first, second", product(PLACES, PLACES))
def test_what_goes_through_two_formats_is_what_it_was(first, second, values, tmp_path):
    found = values
    for number, module in enumerate((first, second)):
        (tmp_path / str(number)).mkdir()
        found = passed(found, module, tmp_path / str(number))
        found = replace(found, body=values.body | found.body)  # what a format has no place for
    assert found.omega == pytest.approx(values.omega, rel=1e-6)
    assert found.wave_direction == pytest.approx(values.wave_direction, abs=1e-6)
    found = about(found, values.rotation_center)
    for name in ("added_mass", "radiation_damping", "excitation_force"):
        true = values.get(name)
        assert np.abs(found.get(name) - true).max() < 3e-6 * np.abs(true).max(), name
    assert (found.water_depth, found.density, found.gravity) == pytest.approx((20.0, RHO, G), rel=1e-9)


def test_wamit_s_files_have_rows_of_both_limits_whatever_is_known(values, tmp_path):
    """Those of the lowest and the highest frequency stand for limits that are not there"""
    known = {name: data for name, data in values.quantities.items() if name != "added_mass_infinity"}
    wamit.write(replace(values, quantities=known), tmp_path / "a.1")
    found = wamit.read(tmp_path / "a.1", WATER)
    A = values.get("added_mass")
    for name, true in (("added_mass_zero", A[0]), ("added_mass_infinity", A[-1])):
        assert found.get(name) == pytest.approx(true, rel=1e-5, abs=1.0)
    wamit.write(values, tmp_path / "a.1")
    again = wamit.read(tmp_path / "a.1", WATER).get("added_mass_infinity")
    assert again == pytest.approx(values.get("added_mass_infinity"), rel=1e-5, abs=1.0)
    one, three = ([line.split() for line in (tmp_path / f"a{end}").open()] for end in (".1", ".3"))
    periods = list(dict.fromkeys(row[0] for row in one if float(row[0]) > 0))
    assert [len(row) for row in one] == [5 if float(row[0]) > 0 else 4 for row in one] and {len(r) for r in three} == {
        7
    }
    assert list(dict.fromkeys(row[0] for row in three)) == periods  # HydroDyn takes them in the order of the .1 file
    headings = {period: list(dict.fromkeys(row[1] for row in three if row[0] == period)) for period in periods}
    assert all(listed == headings[periods[0]] for listed in headings.values())
