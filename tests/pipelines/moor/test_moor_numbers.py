"""What `hakobune moor` prints of a box between two chains in a head wind, by the closed form of such a chain."""

import json
import re

import h5py
import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.bem.database import open_database
from hakobune.pipelines.cli import main

DEPTH, LENGTH, WEIGHT, PRETENSION, BREAKING = 20.0, 300.0, 3000.0, 400e3, 2000e3  # m, N/m, N
FRICTION = 0.2
STUDY = f"""
allowable = 0.5
[water]
depth = {DEPTH}
[hull]
freeboard = 8.0
[wind]
speed = 40.0
direction_deg = 180.0
[types.chain]
weight_N_per_m = {WEIGHT}
axial_stiffness_kN = 1e9
breaking_load_kN = {BREAKING / 1e3}
bed_friction = {FRICTION}
[[lines]]
name = "bow"
type = "chain"
length = {LENGTH}
fairlead = [50.0, 0.0, 0.0]
heading_deg = 0
pretension_kN = {PRETENSION / 1e3}
[[lines]]
name = "stern"
type = "chain"
length = {LENGTH}
fairlead = [-50.0, 0.0, 0.0]
heading_deg = 180
pretension_kN = {PRETENSION / 1e3}
"""


def span(H, h):
    """Horizontal distance of the ends of a chain of LENGTH that lies partly on the bed, h m under its upper end"""
    hung = np.sqrt(h * (h + 2 * H / WEIGHT))
    return LENGTH - hung + H / WEIGHT * np.arcsinh(WEIGHT * hung / H)


def pull(X, h):
    """Horizontal tension at a distance"""
    return brentq(lambda H: span(H, h) - X, 1e3, 5e7)


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """Tables {title: {row: [numbers]}}, everything else that is told, the database, and the file of results"""
    import contextlib
    import io

    folder = tmp_path_factory.mktemp("moor")
    box = f"box --length 100 --beam 50 --draft 10 --depth {DEPTH:g} --panels 60 --gyration 15,29,32 --heading 0,180"
    database = folder / "box.h5"
    assert main([*box.split(), "--omega", "0.06,0.3,0.6,0.9", "--output", str(database)]) == 0
    (folder / "study.toml").write_text(STUDY)
    out, said = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(said):
        words = ["--database", str(database), "--output", str(folder / "moor.h5"), "--json"]
        assert main(["moor", str(folder / "study.toml"), *words]) == 0
    tables = {}
    for line in out.getvalue().splitlines():
        table = json.loads(line)
        rows = [list(row.values()) for row in table["rows"]]
        tables[table["title"]] = {row[0]: [float(value) for value in row[1:]] for row in rows}
    return tables, said.getvalue(), open_database(database), folder / "moor.h5"


def pose(said):
    return [
        float(n) for n in re.search(r"x (\S+) m, y (\S+) m, yaw (\S+)°; heel: roll (\S+)°, pitch (\S+)°", said).groups()
    ]


def test_tensions_are_those_of_chains_at_the_place_of_the_body_and_balance_the_wind(printed):
    """T = H + w h at the upper end; at rest H is the pretension; the difference of both H is the wind"""
    tables, said, _, _ = printed
    x, y, yaw, roll, pitch = pose(said)
    assert (y, yaw, roll) == pytest.approx((0, 0, 0), abs=2e-3) and x < -0.05
    lines, forces = tables["lines, tension at the fairlead"], tables["steady forces"]
    still = (PRETENSION + WEIGHT * DEPTH) / 1e3
    X0, H = span(PRETENSION, DEPTH), {}
    for name, side in (("bow", 1), ("stern", -1)):
        h = DEPTH - side * 50.0 * np.sin(np.radians(pitch))  # a positive pitch takes the bow down
        H[name] = pull(X0 - side * x, h)
        rest, steady, largest, used = lines[name]
        assert rest == pytest.approx(still, abs=0.06)
        assert steady == pytest.approx((H[name] + WEIGHT * h) / 1e3, rel=2e-3)
        assert largest == steady  # no waves
        assert used == pytest.approx(1e5 * largest / BREAKING, abs=0.06)
    assert forces["sum"] == forces["wind"] and forces["wind"][0] < 0
    assert (H["bow"] - H["stern"]) / 1e3 == pytest.approx(-forces["wind"][0], rel=0.01)  # x is told to a millimetre
    assert f"largest tension: {lines['bow'][2]:.0f} kN in bow" in said
    assert f"{lines['bow'][3]:.0f} % of its breaking load (allowable 50 %)" in said


def test_the_wind_is_that_of_the_front_of_the_box(printed):
    """½ρ C U² B f with C of a box ahead, 1.0 to 1.2 in every table of them; its moment about the water at half of f"""
    forces = printed[0]["steady forces"]["wind"]
    q = 0.5 * 1.225 * 40.0**2 * 50.0 * 8.0 / 1e3
    assert 0.9 < -forces[0] / q < 1.35
    assert forces[1] == 0 and forces[2] == 0 and forces[4] == 0


def test_the_period_of_surge_is_that_of_the_mass_on_both_chains(printed):
    """2π √((M + A₁₁)/2H′), H′ of a chain by a difference quotient, A₁₁ of the longest stored wave"""
    tables, _, db, _ = printed
    X0, step = span(PRETENSION, DEPTH), 1e-3
    stiffness = (pull(X0 + step, DEPTH) - pull(X0 - step, DEPTH)) / step  # of both
    mass = 1025.0 * 100 * 50 * 10 + float(db["added_mass"][0][0, 0])
    assert tables["natural periods"]["Surge"][0] == pytest.approx(2 * np.pi * np.sqrt(mass / stiffness), rel=0.02)


def test_the_file_has_the_numbers_of_the_print_and_the_ends_of_the_chains(printed):
    """A chain that lies on the bed pulls its anchor with H less friction and does not lift it; what lies is
    L − √(h(h + 2H/w))"""
    tables, said, _, path = printed
    x, _, _, _, pitch = pose(said)
    lines = tables["lines, tension at the fairlead"]
    with h5py.File(path) as file:
        stored = {name: data[()] for name, data in file["lines"].items()}
        assert file["loads/wind"][0] / 1e3 == pytest.approx(tables["steady forces"]["wind"][0], abs=0.06)
    assert [name.decode() for name in stored["name"]] == ["bow", "stern"]
    for i, (name, side) in enumerate((("bow", 1), ("stern", -1))):
        rest, steady, largest, used = lines[name]
        h = DEPTH - side * 50.0 * np.sin(np.radians(pitch))
        H = pull(span(PRETENSION, DEPTH) - side * x, h)
        lying = LENGTH - np.sqrt(h * (h + 2 * H / WEIGHT))
        by_hand = {
            "pretension": 1e3 * rest, "horizontal_pretension": PRETENSION, "static_tension": 1e3 * steady,
            "maximum_tension": 1e3 * largest, "utilisation": used / 100,
            "maximum_horizontal_anchor_force": H - FRICTION * WEIGHT * lying,
            "maximum_vertical_anchor_force": 0.0, "breaking_load": BREAKING, "length": LENGTH,
            "grounded_length_at_rest": LENGTH - np.sqrt(DEPTH * (DEPTH + 2 * PRETENSION / WEIGHT)),
            "grounded_length_at_maximum": lying, "fairlead_outward": 0.0,
            "fairlead_upward": 0.0,
        }  # fmt: skip
        for key, value in by_hand.items():
            assert stored[key][i] == pytest.approx(value, rel=3e-3, abs=1e-6), key
        assert stored["fairlead"][i] == pytest.approx([side * 50.0, 0.0, 0.0], abs=1e-6)
        assert stored["anchor"][i] == pytest.approx([side * (50.0 + span(PRETENSION, DEPTH)), 0.0, -DEPTH], rel=1e-6)
