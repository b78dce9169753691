"""Wind and current of every study by one table: files, coefficients, ships, superstructures, and who inherits them."""

import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.loads.on_hull import current_on, wind_on
from hakobune.mooring.studies.conditions import ExposedBox
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.weather.streams import no_box, with_files
from hakobune.pipelines.design.kinds.mooring import at
from hakobune.pipelines.moor.study import make_study, read_study
from hakobune.pipelines.single_point.reading import read_study as read_single_point
from hakobune.pipelines.single_point.study import make

HULL = ExposedBox(100.0, 50.0, 10.0, 10.0)
HEAD = "[water]\ndepth = 20.0\n[hull]\nfreeboard = 10.0\n"
ANGLES = np.linspace(0, 360, 41)
ROUND = np.radians(ANGLES)
ROWS = "\n".join(
    f"{a:.9g},{x:.12g},{y:.12g},{n:.12g}"
    for a, x, y, n in zip(ANGLES, 0.9 * np.cos(ROUND) + 0.1, 0.8 * np.sin(ROUND), 0.1 * np.sin(2 * ROUND), strict=True)
)
FILE = f"# area_x = 700\n# area_y = 1900\n# length = 98\n# height = 12\nangle,CX,CY,CN\n{ROWS}\n"
BLOWN = "speed = 30.0\ndirection_deg = 135.0\n"


def wind(text, hull=HULL):
    """StreamOnHull of the [wind] of a study, and its Wind"""
    made = make_study(tomllib.loads(HEAD + text))
    found = made.conditions().wind
    return wind_on(found, hull), found


def test_the_numbers_of_a_file_stand_in_the_study_and_give_its_forces(tmp_path):
    (tmp_path / "ship.csv").write_text(FILE)
    path = tmp_path / "study.toml"
    path.write_text(f'{HEAD}[wind]\nfile = "ship.csv"\n{BLOWN}[current]\nfile = "ship.csv"\n{BLOWN}')
    study, text = read_study(path)
    again = make_study(tomllib.loads(text))  # what a result keeps is enough without the file
    for one in (study, again):
        conditions = one.conditions()
        q = 0.5 * 1.226
        F = wind_on(conditions.wind, HULL).about(np.radians(135.0), (0, 0, 0))
        x, y, n = (0.9 * np.cos(np.radians(135)) + 0.1) * 700, 0.8 * np.sqrt(0.5) * 1900, -0.1 * 1900 * 98
        assert pytest.approx(np.array([x, y, 0, -12 * y, 12 * x, n]) * q, rel=1e-9) == F
        water = current_on(conditions.current, HULL, 1025.0, 20.0).about(np.radians(135.0), (0, 0, 0))
        assert water[:2] == pytest.approx(F[:2] * 1025 / 1.226)
    assert "with coefficients: wind of ship.csv, current of ship.csv" in text


def test_a_single_point_and_a_moored_body_take_the_same_file_alike(tmp_path):
    (tmp_path / "ship.csv").write_text(FILE)
    study = tmp_path / "study.toml"
    study.write_text(f'{HEAD}[wind]\nfile = "ship.csv"\n{BLOWN}')
    moored = wind_on(read_study(study)[0].conditions().wind, HULL).unit(np.radians(135.0))
    study.write_text(
        f'[wind]\nfile = "ship.csv"\n{BLOWN}[current]\nfile = "ship.csv"\n{BLOWN}'
        "[water]\ndepth = 20.0\n[hull]\nlength = 100.0\nbeam = 50.0\ndraft = 10.0\n"
        "[mass]\nadded_surge = 0.1\nadded_sway = 0.6\nadded_yaw = 0.4\n[attachment]\nx = 50.0\n[buoy]\nz = -3.0\n"
        '[types.chain]\nweight_kg_per_m = 241.4\n[mooring]\ntype = "chain"\nlength = 150.0\ncount = 6\n'
        "pretension_kN = 150.0\n"
    )
    load = make(read_single_point(study)[0]).point.loads.wind
    assert load.ring(np.radians(135.0)) == pytest.approx(moored, rel=1e-6)
    assert load.height == (12.0, 12.0)


@pytest.mark.parametrize(
    ("angles", "y"), [([0, 45, 90, 135, 180], [0, 0.7, 1, 0.7, 0]), ([0, 90, 180, 270, 360], [0, 1, 0, -1, 0])]
)
def test_numbers_of_the_study_go_all_round_on_the_areas_of_its_hull(angles, y):
    x = np.cos(np.radians(angles)).round(1)
    F, _ = wind(f"[wind]\ncoefficients = {{ angles_deg = {angles}, x = {x.tolist()}, y = {y} }}\n{BLOWN}")
    q = 0.5 * 1.226
    assert F.unit(np.pi / 2) == pytest.approx([0, q * 1000, 0], abs=1e-6)
    assert F.unit(np.pi) == pytest.approx([-q * 500, 0, 0], abs=1e-6)
    assert F.height == (5.0, 5.0)


def test_superstructures_are_seen_by_the_wind_of_a_moored_body():
    text = f"superstructure_side = 500.0\nsuperstructure_z = 18.0\n[wind]\n{BLOWN}"
    study = make_study(tomllib.loads(HEAD + text))
    hull = study.hull_of({"length": 100.0, "beam": 50.0, "draft": 10.0})
    abeam = wind_on(study.conditions().wind, hull).about(np.pi / 2, (0, 0, 0))
    assert abeam[1] == pytest.approx(0.5 * 1.226 * 1500)
    assert abeam[3] == pytest.approx(-0.5 * 1.226 * (1000 * 5 + 500 * 18))


def test_a_ship_by_name_has_blendermanns_coefficients_on_its_silhouette():
    F, _ = wind(f'[wind]\nship = "tanker, loaded"\n{BLOWN}')
    q = 0.5 * 1.226
    assert F.unit(np.pi / 2) == pytest.approx([0, 0.70 * q * 1000, 0], abs=1e-6)
    assert F.height[1] == pytest.approx(3.1 * 5.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f'[wind]\nship = "ocimf"\n{BLOWN}', "wind.ship is 'ocimf'; allowed: car carrier; .*OCIMF, which are "
        "not public, by wind.file"),
        (f'[wind]\nfile = "a.csv"\n{BLOWN}', "wind.file is given in a study that was not read from a file"),
        (f"[wind]\ncenter_z = nan\n{BLOWN}", "wind.center_z is nan"),
        ("superstructure_side = -1.0\n", "hull.superstructure_side is -1"),
        (f"[wind]\ncoefficients = {{ angles_deg = [0, 90], x = [1, 0], y = [0, 1], area_x = 3 }}\n{BLOWN}",
         "wind.coefficients.area_x is given; allowed only with angles_deg up to 180 or 360"),
        (f"[wind]\ncoefficients = {{ angles_deg = [0, 90, 170], x = [1, 0, 0], y = [0, 1, 0] }}\n{BLOWN}",
         "wind.coefficients: hull coefficients have shapes"),
    ],
)  # fmt: skip
def test_a_fault_is_told_by_its_key_before_anything_is_solved(text, said):
    with pytest.raises(StudyError, match=said):
        study = make_study(tomllib.loads(HEAD + text))
        study.hull_of({"length": 100.0, "beam": 50.0, "draft": 10.0})
        study.conditions()


def test_a_file_that_is_not_there_or_is_given_twice_is_told(tmp_path):
    path = tmp_path / "study.toml"
    for more, said in (("", "wind.file: .*ship.csv"), ('ship = "ferry"\n', "wind: ship and file are both given")):
        text = f'[wind]\nfile = "ship.csv"\n{more}'
        with pytest.raises(StudyError, match=said):
            with_files(tomllib.loads(text), text, path)


def test_a_hull_that_is_no_box_is_told_with_the_way_out():
    bare, files = SimpleNamespace(coefficients=None), SimpleNamespace(coefficients=object())
    ship = SimpleNamespace(coefficients=None, ship="ferry")
    (line,) = no_box(0.8, HULL, SimpleNamespace(wind=bare, current=bare))
    assert line.startswith("wind and current act as on a box of 100 by 50 m, which the hull is not: it fills 80 %")
    assert line.endswith('give wind.ship = "…" or wind.file, and current.ship = "tanker" or current.file')
    (line,) = no_box(0.8, HULL, SimpleNamespace(wind=ship, current=bare))
    assert line.startswith("current acts as") and line.endswith('give current.ship = "tanker" or current.file')
    for block, wind_given, current in ((0.8, files, files), (1.0, bare, bare), (0.8, None, None)):
        assert no_box(block, HULL, SimpleNamespace(wind=wind_given, current=current)) == []


def test_every_state_of_a_design_has_the_coefficients_of_its_hull_unless_it_has_its_own():
    own = {"angles_deg": [0, 90], "x": [1, 0], "y": [0, 1]}
    base = {"water": {"depth": 20.0}, "of_hull": {"wind": {"ship": "ferry", "center_z": 9.0}, "current": {}}}
    plain = at(base, 20.0, {"wind": {"speed": 50.0}, "current": {"speed": 1.0}})
    assert plain["wind"] == {"ship": "ferry", "center_z": 9.0, "speed": 50.0} and plain["current"] == {"speed": 1.0}
    other = at(base, 20.0, {"wind": {"speed": 50.0, "coefficients": own}})
    assert other["wind"] == {"center_z": 9.0, "speed": 50.0, "coefficients": own}
    assert "of_hull" not in plain and "current" not in other
