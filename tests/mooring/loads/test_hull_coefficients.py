"""Coefficients of the user: published worked examples, symmetry, smoothness, files and their faults."""

import numpy as np
import pytest
from kinks import assert_slope_is_continuous

from hakobune.mooring.loads.coefficients import (
    hull_coefficients,
    hull_force,
    read_hull_coefficients,
    shallow_coefficient,
)

KNOT_OCIMF = np.sqrt(2 / 7.6)  # m/s: ½ρU² in N is ρ V² 1000/7600 for V in knots
KNOT = 1852 / 3600
ANGLES = np.radians([0, 30, 60, 90, 120, 150, 170, 180])
LENGTH = 329.3  # m, of the 250 000 dwt tanker in OCIMF, Mooring Equipment Guidelines (2nd edition, 1997), appendix D

# at 150° and 170° from the example; other values only have to be there
WIND = """# 250 000 dwt tanker, loaded, wind
# area_x = 818.0
# area_y = 3225.0
# length = 329.3
angle,CX,CYA,CYF
180,-0.9,0,0
170,-0.9,0.05,0.03
150,-0.73,0.19,0.13
120,-0.4,0.40,0.24
90,0.1,0.48,0.25
60,0.5,0.45,0.12
30,0.7,0.2,0.03
0,0.8,0,0
"""


@pytest.fixture
def wind(tmp_path):
    path = tmp_path / "wind.csv"
    path.write_text(WIND, encoding="utf-8")
    return read_hull_coefficients(path)


def test_wind_on_a_tanker_is_that_of_the_ocimf_example(wind):
    """60 knots at 150°: −346 kN along, 355 and 243 kN at the aft and forward perpendiculars."""
    F_x, F_y, M_z = hull_force(wind, 60 * KNOT_OCIMF, np.radians(150), 1.223)
    assert np.isclose(F_x, -346e3, atol=500)
    forward, aft = F_y / 2 + M_z / LENGTH, F_y / 2 - M_z / LENGTH
    assert np.isclose(aft, 355e3, atol=500) and np.isclose(forward, 243e3, atol=500)


def test_ocimf_rounds_its_knot():
    """With the knot of 1852 m an hour forces are 0.57 % larger."""
    assert np.isclose((KNOT / KNOT_OCIMF) ** 2, 1.0057, atol=1e-4)


def test_current_on_a_tanker_is_that_of_the_ocimf_example():
    """2 knots at 170°, water depth 1.1 drafts of 19.2 m: 597 kN aft, 1534 kN (1534.9 cut off) forward on L T."""
    aft, forward = np.array([0, 0.3, 0.6, 1.0, 0.8, 0.4, 0.175, 0]), np.array([0, 0.2, 0.6, 1.2, 1.3, 1.1, 0.45, 0])
    area = LENGTH * 19.2
    tanker = hull_coefficients(
        ANGLES, 0 * aft, aft + forward, (forward - aft) / 2, area_x=area, area_y=area, length=LENGTH
    )
    _, F_y, M_z = hull_force(tanker, 2 * KNOT_OCIMF, np.radians(170), 1025.0)
    assert np.isclose(F_y / 2 - M_z / LENGTH, 597e3, atol=500)
    assert np.isclose(F_y / 2 + M_z / LENGTH, 1534.9e3, atol=50)


def test_current_on_a_frigate_in_shallow_water_is_that_of_the_ufc_table():
    """UFC 4-159-03 (2005), table 4-6: FFG-7, 1.5 m/s, K = 2; C₀ = 0.851 is what its first row gives on L T."""
    length, draft = 124.5, 4.389
    for share, force in ((0.096, 0.55), (0.288, 0.66), (0.576, 1.03), (0.72, 1.30), (0.96, 1.90)):
        value = shallow_coefficient(0.851, draft, draft / share)
        assert np.isclose(0.5 * 1025 * 1.5**2 * length * draft * value / 1e6, force, atol=0.005)
    with pytest.raises(ValueError, match=r"depth is 4 m; allowed: at least the draft 4.389 m"):
        shallow_coefficient(0.851, draft, 4.0)


def test_every_row_of_a_file_is_returned(wind):
    for line in WIND.splitlines()[5:]:
        angle, x, aft, forward = map(float, line.split(","))
        assert np.allclose(wind.curve(np.radians(angle)), [x, aft + forward, (forward - aft) / 2], atol=1e-12)


def test_a_hull_given_to_180_degrees_is_the_same_on_both_sides(wind):
    for degrees in (10.0, 77.0, 150.0):
        one, other = (hull_force(wind, 20.0, np.radians(d), 1.2) for d in (degrees, -degrees))
        assert np.allclose(one, other * (1, -1, -1))


def test_slopes_are_continuous_all_the_way_round(wind):
    for i in range(3):
        assert_slope_is_continuous(lambda d, i=i: wind.curve(np.radians(d % 360))[i], np.arange(0.0, 360.0, 15.0), 0.5)


def test_box_angles_to_360_degrees_need_no_symmetry():
    angle = np.radians(np.arange(0.0, 361.0, 45.0))
    lopsided = hull_coefficients(angle, np.cos(angle), 0.1 + 0 * angle, 0 * angle, area_x=1, area_y=2, length=3)
    assert np.allclose(hull_force(lopsided, 2.0, np.radians([0, 45, 300, 360]), 1.0)[:, 1], 0.1 * 2.0 * 2)


def test_moments_may_have_an_area_of_their_own(tmp_path):
    path = tmp_path / "one.csv"
    path.write_text(WIND.replace("# length", "# area_n = 645.0\n# length"), encoding="utf-8")
    (tmp_path / "two.csv").write_text(WIND, encoding="utf-8")
    one, two = (hull_force(read_hull_coefficients(p), 9.0, 1.0, 1.2) for p in (path, tmp_path / "two.csv"))
    assert np.allclose(one, two)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("# area_x = 818.0\n", "", "wind.csv: area_x is not given; allowed: a line"),
        ("area_x = 818.0", "area_x = big", "line 2: 'big' is not a number"),
        ("area_y = 3225.0", "area_y = -1", "area_y is -1; allowed: above 0"),
        ("angle,CX,CYA,CYF", "angle,CX,CY", "columns are angle,CX,CY; allowed: angle,CX,CY,CN or"),
        ("30,0.7,0.2,0.03", "30,0.7,0.2", "line 12 has 3 values; allowed: 4"),
        ("30,0.7,0.2,0.03", "30,0.7,x,0.03", "line 12: 'x' is not a number"),
        ("30,0.7", "30,nan", "not all finite"),
        ("180,-0.9,0,0\n", "", "angles run from 0° to 170°"),
        ("180,-0.9,0,0", "180,-0.9,0.1,0", "y is 0 at 0°, 0.1 at 180°"),
        ("30,0.7", "60,0.7", "rising"),
    ],
)
def test_a_file_that_cannot_be_is_refused_in_one_line(tmp_path, old, new, message):
    path = tmp_path / "wind.csv"
    assert old in WIND
    path.write_text(WIND.replace(old, new), encoding="utf-8")
    with pytest.raises(ValueError, match=message) as error:
        read_hull_coefficients(path)
    assert "\n" not in str(error.value)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ValueError, match=r"none\.csv does not exist"):
        read_hull_coefficients(tmp_path / "none.csv")
    (tmp_path / "empty.csv").write_text("# area_x = 1\n# area_y = 1\n# length = 1\n", encoding="utf-8")
    with pytest.raises(ValueError, match="columns are missing"):
        read_hull_coefficients(tmp_path / "empty.csv")
