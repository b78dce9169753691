"""Files as other programs write them, not as this one does; each number by the formula of that program's manual."""

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.formats import hams, orcaflex, wamit
from hakobune.bem.formats.afloat import Weight, on_hull
from hakobune.bem.formats.values import FormatError, about, omega_of, values_of, with_headings_once
from hakobune.meshing.files import read_mesh, write_mesh
from hakobune.pipelines import cli
from hakobune.pipelines.exchange.importing import hull_of
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

RHO, G, DEPTH = 1025.0, 9.80665, 20.0
WATER = {"water_depth": DEPTH, "density": RHO, "gravity": G}
MODES = np.array([0, 0, 0, 1, 1, 1])


@pytest.fixture(scope="module")
def values(tmp_path_factory):
    """A box of 20 x 10 x 4 m about its middle in the waterplane, so that symmetry makes 26 of 36 pairs zero"""
    path = tmp_path_factory.mktemp("others") / "box.h5"
    raw = {
        "water": {"depth": DEPTH},
        "bodies": [{"shape": "box", "length": 20.0, "beam": 10.0, "draft": 4.0, "gyration": [3, 6, 6]}],
        "waves": {"omegas": [0.6, 1.0], "headings_deg": [0, 90]},
    }
    solve(make_scene(raw), path)
    return values_of(open_database(path))


@pytest.fixture
def written(values, tmp_path):
    """NAME of the files of WAMIT of the box, with its hull beside"""
    wamit.write(values, tmp_path / "box")
    write_mesh(values.mesh, tmp_path / "box.gdf")
    return tmp_path / "box.1"


def rewritten(path, change):
    """A file of numbers whose rows are changed or left out (None)"""
    rows = [change([float(word) for word in line.split()]) for line in path.read_text().splitlines()]
    path.write_text("\n".join(" ".join(f"{x:.9E}" for x in row) for row in rows if row is not None))


def test_pairs_that_symmetry_makes_zero_may_be_left_out(values, written):
    allowed = {(1, 1), (2, 2), (3, 3), (4, 4), (5, 5), (6, 6), (1, 5), (5, 1), (2, 4), (4, 2)}
    rewritten(written, lambda row: row if (int(row[1]), int(row[2])) in allowed else None)
    rewritten(written.with_suffix(".3"), lambda row: row if row[2] != 6 else None)
    found = wamit.read(written, WATER)
    A, size = values.get("added_mass"), np.abs(values.get("added_mass")).max()
    assert np.allclose(found.get("added_mass"), A, atol=1e-6 * size)
    assert np.count_nonzero(found.get("added_mass")[0]) == 10
    X = found.get("excitation_force")
    assert np.allclose(X[..., :5], values.get("excitation_force")[..., :5], rtol=1e-5, atol=1.0) and not X[..., 5].any()


def test_a_pair_that_is_there_at_some_frequencies_alone_is_a_damaged_file(written):
    lines = written.read_text().splitlines()
    written.write_text("\n".join(line for line in lines[:-1]))
    with pytest.raises(FormatError, match="0 values for"):
        wamit.read(written, WATER)


def test_modes_beyond_six_are_of_another_body_or_of_bending_where_the_inputs_have_one(values, written):
    lines = written.read_text().splitlines()
    other = [line.replace("     1     1 ", "     7     7 ") for line in lines if "     1     1 " in line]
    written.write_text("\n".join([*lines, *other]))
    with pytest.raises(
        FormatError, match=r"has 2 bodies; give one of them by --body, 1 to 2; the other bodies are held"
    ):
        wamit.read(written, WATER)
    first = wamit.read(written, WATER | {"body": 1})
    assert first.get("added_mass") == pytest.approx(values.get("added_mass"), rel=1e-5, abs=1.0) and first.others == 1
    second = wamit.read(written, WATER | {"body": 2})
    assert second.get("added_mass")[:, 0, 0] == pytest.approx(values.get("added_mass")[:, 0, 0], rel=1e-5)
    assert np.count_nonzero(second.get("added_mass")) == len(values.omega)
    pot = "h\n20.0\n1 1\n-1\n0.6 0.4\n1\n0.0\n1\none.gdf\n0 0 0 0\n"
    written.with_suffix(".pot").write_text(pot)
    bending = wamit.read(written, WATER)
    assert np.array_equal(bending.get("added_mass"), first.get("added_mass")) and bending.others == 1


def test_results_are_made_dimensionless_by_ulen(values, written):
    """A = ρ L^(3 + p + q) Ā, X = ρ g L^(2 + p) X̄, C = ρ g L^(2 + p + q) C̄, motions ξ̄ L^(−p); WAMIT manual, "
    "chapter 3"""
    L = 10.0
    power = {number: MODES[number - 1] for number in range(1, 7)}
    rewritten(
        written,
        lambda row: [*row[:3], *(x / L ** (3 + power[int(row[1])] + power[int(row[2])]) for x in row[3:])],
    )
    for suffix, exponent in ((".3", 2), (".4", None)):
        rewritten(
            written.with_suffix(suffix),
            lambda row, e=exponent: [
                *row[:3], row[3], row[4],
                *(x * (L ** power[int(row[2])] if e is None else L ** -(e + power[int(row[2])])) for x in row[5:]),
            ],
        )  # fmt: skip
    rewritten(
        written.with_suffix(".hst"),
        lambda row: [*row[:2], row[2] / L ** (2 + power[int(row[0])] + power[int(row[1])])],
    )
    for suffix in (".3fk", ".3sc", ".8"):
        written.with_suffix(suffix).unlink(missing_ok=True)
    gdf = written.with_suffix(".gdf")
    gdf.write_text(gdf.read_text().replace("1.0 9.80665 ULEN", "10.0 9.80665 ULEN"))
    found = wamit.read(written, WATER)
    for name in ("added_mass", "radiation_damping", "excitation_force", "rao"):
        true = values.get(name)
        assert np.allclose(found.get(name), true, rtol=2e-6, atol=2e-6 * np.abs(true).max()), name
    C = values.get("hydrostatic_stiffness")
    assert np.allclose(found.get("hydrostatic_stiffness"), C, rtol=1e-5, atol=1e-6 * C.max())
    # taken with the wrong length, the hull tells
    wrong = wamit.read(written, WATER | {"length_unit": 1.0})
    with pytest.raises(FormatError, match=r"dimensionless is 10 times as large \(--length-unit\)"):
        on_hull(wrong, values.mesh)


def test_xbody_is_the_point_of_moments_and_moves_the_hull(values, written, tmp_path, capsys):
    wamit.write(about(values, (0.0, 0.0, -2.0)), written)
    pot = "h\n20.0 HBOT\n1 1 IRAD IDIFF\n-2 NPER\n0.6 0.4\n2\n0.0\n90.0 BETA\n1\nbox.gdf\n0.0 0.0 -2.0 0.0 XBODY\n"
    written.with_suffix(".pot").write_text(pot)
    assert wamit.inputs_of(written, WATER).about == (0.0, 0.0, -2.0)
    for suffix in (".hst", ".4", ".8"):
        written.with_suffix(suffix).unlink()
    words = ["mesh", str(written.with_suffix(".gdf")), "--move", "0,0,2", "--output", str(tmp_path / "own.gdf")]
    assert cli.main(words) in (0, 1)  # the hull in the body's axes stands out of the water
    shutil.move(tmp_path / "own.gdf", written.with_suffix(".gdf"))
    output = tmp_path / "x.h5"
    assert cli.main(["import", str(written), "--from", "wamit", "--depth", "20", "--output", str(output)]) == 0
    assert "XBODY 0, 0, -2 m of box.pot is taken" in capsys.readouterr().err
    db = open_database(output)
    assert list(db.rotation_center) == [0, 0, -2]
    assert db.header.body["center_of_buoyancy"][2] == pytest.approx(-2.0)  # half of the draft
    wamit.write(values, written)  # moments about the waterplane beside an input that says otherwise
    assert cli.main(["import", str(written), "--from", "wamit", "--output", str(output), "--fresh"]) == 2
    said = capsys.readouterr().err
    assert "moments and rotations are about (0, 0, 0) m; give --about 0,0,0, or import with --correct" in said
    pot = pot.replace("-2.0 0.0 XBODY", "-2.0 30.0 XBODY")
    written.with_suffix(".pot").write_text(pot)
    with pytest.raises(FormatError, match=r"XBODY\(4\) turns the body by 30°"):
        wamit.read(written, WATER)


def test_an_input_file_is_read_for_what_is_not_given(written):
    body = "0.0 0.0 -{0}. 0.0\n1 1 1 1 1 1\n"
    head = "h\n-1.0\n1 1\n-1\n0.6 0.4\n1\n0.0\n2\n"
    written.with_suffix(".pot").write_text(head + "one.gdf\n" + body.format(1) + "two.gdf\n" + body.format(2))
    first, second = (wamit.inputs_of(written, {"body": body}) for body in (1, 2))
    assert first.about == (0, 0, -1) and second.about == (0, 0, -2) and first.bodies == 2 and first.depth == np.inf
    assert wamit.inputs_of(written, WATER | {"rotation_center": (0, 0, 1)}).about == (0, 0, 1)
    written.with_suffix(".pot").write_text(head + "one.gdf\n")
    with pytest.raises(FormatError, match="ends before XBODY"):
        wamit.inputs_of(written, WATER)


def test_lengths_are_feet_where_gravity_is_and_wavenumbers_are_times_ulen(values, written):
    """WAMIT manual, chapter 4: first columns K L or ν L where IPEROUT is 3 or 4"""
    gdf = written.with_suffix(".gdf")
    gdf.write_text(gdf.read_text().replace("1.0 9.80665 ULEN", "10.0 32.174 ULEN"))
    pot = "h\n20.0\n1 1\n-1\n0.6 0.4\n1\n0.0\n1\none.gdf\n0 0 -5 0\n"
    written.with_suffix(".pot").write_text(pot)
    found = wamit.inputs_of(written, WATER)
    assert found.length == pytest.approx(3.048) and found.about == pytest.approx((0, 0, -1.524))
    written.with_suffix(".cfg").write_text("IPEROUT = 3\n")
    for suffix in (".1", ".3", ".3fk", ".3sc", ".4", ".8"):
        rewritten(
            written.with_suffix(suffix),
            lambda row: [(2 * np.pi / row[0]) ** 2 / G * 3.048 if row[0] > 0 else -1 - row[0], *row[1:]],
        )
    assert wamit.read(written, WATER).omega == pytest.approx(values.omega, rel=1e-5)


def test_headings_a_turn_apart_are_one(values):
    X = values.get("excitation_force")
    both = np.concatenate([X, X[:, :1]], axis=1)
    ends = np.array([-np.pi, 0.0, np.pi])
    twice = replace(values, wave_direction=ends, quantities={"excitation_force": both})
    once = with_headings_once(twice)
    assert np.allclose(once.wave_direction, [-np.pi, 0.0])
    assert np.array_equal(once.get("excitation_force"), X)
    other = replace(twice, quantities={"excitation_force": both * np.array([1, 1, 1.01])[:, None]})
    with pytest.raises(FormatError, match="between headings -180° and 180°, which are the same direction"):
        with_headings_once(other)


@pytest.mark.parametrize(
    ("kind", "column"),
    [
        ("period", lambda w, k: 2 * np.pi / w),
        ("frequency", lambda w, k: w),
        ("wavenumber", lambda w, k: k),
        ("deep wavenumber", lambda w, k: w**2 / G),
        ("wavelength", lambda w, k: 2 * np.pi / k),
    ],
)
def test_any_first_column_of_results_is_the_same_frequency(kind, column):
    k = np.array([0.05, 0.2, 1.0])
    w = np.sqrt(G * k * np.tanh(k * DEPTH))
    assert np.allclose(omega_of(column(w, k), kind, DEPTH, G), w, rtol=1e-12)
    limits = omega_of(np.array([-1.0, 0.0]), kind, DEPTH, G)
    assert set(limits) == {0.0, np.inf}
    assert (limits[0] == 0.0) == (kind in ("period", "wavelength"))


def test_a_control_file_of_hams_ends_at_its_last_line(values, tmp_path):
    hams.write(values, tmp_path)
    control = tmp_path / "Input" / "ControlFile.in"
    text = control.read_text()
    assert "Output_frequency_type   4" in text
    control.write_text(
        text.replace("Waterdepth  20.000000D0", "Waterdepth  20.D0   (a negative value denotes the infinite depth)")
        + "\n   Output_frequency_type options: same as Input_frequency_type options\n   Waterdepth 7.D0\n"
    )
    found = hams.read(tmp_path, WATER)
    assert found.water_depth == DEPTH and np.allclose(found.omega, values.omega)


def test_a_body_of_hams_mrel_is_read_by_its_number(values, tmp_path):
    """Rows 7 to 12 are of the second body, about its own point; results have the names of that program"""
    hams.write(values, tmp_path)
    (tmp_path / "Input" / "Hydrostatic.in").unlink()
    control = tmp_path / "Input" / "ControlFile.in"
    control.write_text(
        control.read_text().replace(
            "Reference_body_center ",
            "Number_of_bodies 2\nLCS_1 0 0 0 0\nLCS_2 9 0 0 0\nReference_body_center_2 9.0 0.0 -1.0 #",
        )
    )
    for old, new in wamit.NAMES_OF_HAMS.items():
        place = (tmp_path / hams.RESULTS).with_suffix(old)
        if place.exists():
            shift, rows = {".1": (1, 2), ".hst": (0, 1)}.get(old, (2,)), [line.split() for line in place.open()]
            moved = [" ".join(str(int(x) + 6) if i in shift else x for i, x in enumerate(row)) for row in rows]
            place.with_name(new + old).write_text("\n".join(moved))
            place.unlink()
    found = hams.read(tmp_path, WATER | {"body": 2})
    assert found.rotation_center == pytest.approx([9, 0, -1]) and found.others == 1
    assert "HullMesh_2.pnl has its origin at (9, 0, 0) m and is moved there" in found.left_out[-1]
    known, inputs = WATER | {"body": 2}, tmp_path / "Input"
    (inputs / "HullMesh.pnl").rename(inputs / "HullMesh_2.pnl")
    drawn = read_mesh(inputs / "HullMesh_2.pnl").whole().points[:, 0]
    moved = hull_of(tmp_path, None, hams, None, known).points[:, 0]
    assert (moved.min(), moved.max()) == pytest.approx((drawn.min() + 9, drawn.max() + 9))
    assert hull_of(tmp_path, None, hams, inputs / "HullMesh_2.pnl", known).points[:, 0].max() == drawn.max()
    for name in ("added_mass", "excitation_force", "hydrostatic_stiffness"):
        assert np.allclose(found.get(name), values.get(name), rtol=1e-5, atol=1e-5 * np.abs(values.get(name)).max())
    control.write_text(control.read_text().replace("LCS_2 9 0 0 0", "LCS_2 9 0 0 30"))
    with pytest.raises(FormatError, match="LCS_2 turns the body"):
        hams.read(tmp_path, WATER | {"body": 2})


def test_a_model_of_orcaflex_in_kg_and_newton_or_in_feet_and_kips_is_that_in_tonnes(values, tmp_path):
    """1 kip is 453.59237 kg or 4448.2216 N, 1 ft 0.3048 m"""
    orcaflex.write(values, tmp_path / "si.yml")
    text = (tmp_path / "si.yml").read_text()
    assert "CentreOfMass" in text and "CentreOfGravity" not in text
    true = orcaflex.read(tmp_path / "si.yml", {"gravity": G})
    (tmp_path / "old.yml").write_text(text.replace("CentreOfMass", "CentreOfGravity"))
    assert np.array_equal(orcaflex.read(tmp_path / "old.yml", {"gravity": G}).get("center_of_mass"), [0, 0, 0])
    for name, general, m, kg, N in (
        ("user", "UnitsSystem: User\n  LengthUnits: m\n  MassUnits: kg\n  ForceUnits: N", 1.0, 1.0, 1.0),
        ("us", "UnitsSystem: US", 0.3048, 453.59237, 4448.2216152605),
    ):
        found = read_in_units(text.replace("UnitsSystem: SI", general), m, kg, N, tmp_path / f"{name}.yml")
        assert found.density == pytest.approx(RHO) and found.water_depth == pytest.approx(DEPTH)
        for quantity in ("added_mass", "radiation_damping", "excitation_force", "rao"):
            assert np.allclose(found.get(quantity), true.get(quantity), rtol=1e-12), quantity
        for part in ("mass", "inertia_matrix", "hydrostatic_stiffness", "displaced_volume"):
            assert np.allclose(found.get(part), true.get(part), rtol=1e-9), part
    (tmp_path / "odd.yml").write_text(text.replace("UnitsSystem: SI", "UnitsSystem: User\n  MassUnits: stone"))
    with pytest.raises(FormatError, match="MassUnits is 'stone'; allowed: te, t, kg"):
        orcaflex.read(tmp_path / "odd.yml", {"gravity": G})


def read_in_units(text, m, kg, N, path):
    """The model of a text in t, kN, m, each number written anew in other units by its key"""
    from ruamel.yaml import YAML

    model = YAML(typ="safe", pure=True).load(text)
    mass, force, arm = 1e3 / kg, 1e3 / N, (1 / m) ** (MODES + MODES[:, None])
    model["Environment"]["Density"] *= mass * m**3
    model["Environment"]["WaterDepth"] /= m
    (draught,) = model["VesselTypes"][0]["Draughts"]
    draught["Mass"] *= mass
    draught["DisplacedVolume"] /= m**3
    for key in ("CentreOfMass", "CentreOfBuoyancy", "ReferenceOrigin"):
        draught[key] = (np.array(draught[key]) / m).tolist()
    scaled(draught, orcaflex.INERTIA_COLUMNS, mass / m**2)
    scaled(draught, orcaflex.STIFFNESS_COLUMNS, force * m * arm[2:5, 2:5])
    for row in draught["FrequencyDependentAddedMassAndDamping"]:
        scaled(row, orcaflex.MASS_COLUMNS, mass * arm)
        scaled(row, orcaflex.DAMPING_COLUMNS, force * m * arm)
    for group, size in (("LoadRAOs", force * m * m ** -MODES.astype(float)), ("DisplacementRAOs", m**MODES)):
        for heading in draught[group]["RAOs"]:
            factors = np.ones(13)
            factors[1::2] = size
            scaled(heading, orcaflex.RAO_COLUMNS, factors)
    text = json.dumps(model, default=str).replace('"ForceUnits": "N"', '"ForceUnits": N')  # as OrcaFlex writes it
    path.write_text(f"%YAML 1.1\n---\n{text}\n")
    return orcaflex.read(path, {"gravity": G})


def scaled(table, key, factor):
    table[key] = (np.array(table[key], float) * factor).tolist()


def test_an_import_without_mass_is_given_one_and_has_the_motions_of_the_solved_body(values, written, tmp_path, capsys):
    written.with_suffix(".4").unlink()
    written.with_suffix(".8").unlink()
    output = tmp_path / "given.h5"
    words = ["import", str(written), "--from", "wamit", "--depth", "20", "--output", str(output)]
    assert cli.main(words) == 0
    assert (
        "the database has no inertia_matrix, so that no motions can be computed; give it by `hakobune body` "
        "with --gyration"
    ) in capsys.readouterr().err
    assert cli.main([*words, "--fresh", "--gyration", "3,6,6"]) == 0
    assert "the value in the files includes the weight" in capsys.readouterr().err
    db = open_database(output)
    assert np.allclose(db["rao"], values.get("rao"), rtol=1e-4, atol=1e-5)
    assert db.header.body["mass"] == pytest.approx(RHO * 800)
    assert cli.main([*words, "--fresh", "--gyration", "3,6,6", "--mass", "820"]) == 2
    assert "mass is 820 kg, the hull displaces 820000 kg" in capsys.readouterr().err


def test_a_stiffness_without_the_weight_is_known_by_its_roll_and_pitch(values):
    C = np.array(values.get("hydrostatic_stiffness"))  # of a weight at the rotation centre, which has no arm
    mass = values.get("mass")
    still = replace(values, body={"hydrostatic_stiffness": C})
    raised, remarks = on_hull(still, values.mesh, Weight(center=(0.0, 0.0, 1.0), gyration=(3, 6, 6)))
    assert "the value in the files does not include the weight" in remarks[0]
    lowered = raised.get("hydrostatic_stiffness")[3, 3] - C[3, 3]
    assert lowered == pytest.approx(-mass * G * 1.0, rel=1e-6)  # −m g z_G


def test_a_quote_in_the_name_of_a_vessel_is_doubled_between_quotes():
    """YAML 1.1, 5.7.3: '' in a text between single quotes"""
    assert orcaflex._quoted("O'Brien's") == "'O''Brien''s'"


@pytest.mark.parametrize("lacks, told", [((), True), (("mass",), False), (("inertia_matrix",), False)])
def test_orcaflex_is_told_a_mass_with_its_inertia_or_neither(values, tmp_path, lacks, told):
    """Its Mass stands beside MomentOfInertiaTensor and CentreOfMass in a draught"""
    body = {name: one for name, one in values.body.items() if name not in lacks}
    orcaflex.write(replace(values, body=body), tmp_path / "one.yml")
    lines = [line.strip() for line in (tmp_path / "one.yml").read_text().splitlines()]
    assert any(line.startswith("Mass: ") for line in lines) is told
    assert any(line.startswith(orcaflex.INERTIA_COLUMNS) for line in lines) is told


def test_a_potential_file_without_a_hull_is_in_metres(written):
    """Depth 20, XBODY(3) −5; the hull that it names tells the unit where it is there"""
    gdf = written.with_suffix(".gdf")
    text = gdf.read_text()
    gdf.unlink()
    written.with_suffix(".pot").write_text("h\n20.0\n1 1\n-1\n0.6 0.4\n1\n0.0\n1\none.gdf\n0 1 -5 0\n")
    found = wamit.inputs_of(written, {})
    assert (found.depth, found.about, found.length, found.hull) == (20.0, (0.0, 1.0, -5.0), 1.0, "")
    assert "water depth 20 m of box.pot" in found.said and "XBODY 0, 1, -5 m of box.pot" in found.said
    gdf.with_name("one.gdf").write_text(text.replace("1.0 9.80665 ULEN", "10.0 32.174 ULEN"))
    found = wamit.inputs_of(written, {})
    assert found.depth == pytest.approx(20 * 0.3048) and found.about == pytest.approx((0, 0.3048, -5 * 0.3048))
    assert found.length == pytest.approx(3.048) and found.hull == "one.gdf" and found.told and found.bodies == 1


def test_a_kind_of_the_first_column_that_is_given_is_taken_with_wavenumbers_as_they_are(written):
    """IPEROUT of a .cfg is not asked then; wavenumbers are not times ULEN"""
    gdf = written.with_suffix(".gdf")
    gdf.write_text(gdf.read_text().replace("1.0 9.80665 ULEN", "10.0 9.80665 ULEN"))
    written.with_suffix(".cfg").write_text("IPEROUT = 3\n")
    found = wamit.inputs_of(written, WATER)
    assert (found.period_kind, found.wave_length) == ("deep wavenumber", 10.0)
    found = wamit.inputs_of(written, WATER | {"period_kind": "wavenumber"})
    assert (found.period_kind, found.wave_length, found.length) == ("wavenumber", 1.0, 10.0)
    written.with_suffix(".cfg").write_text("IPEROUT = 5\n")
    with pytest.raises(FormatError, match="IPEROUT is 5; allowed: 1, 2, 3, 4"):
        wamit.inputs_of(written, WATER)
    written.with_suffix(".cfg").unlink()
    assert wamit.inputs_of(written, WATER).period_kind == "period" and not wamit.inputs_of(written, WATER).told
