"""Rows of a database: what is one frequency or heading, what is lacking, what is said of files."""

import json
import os

import h5py
import numpy as np
import pytest
from test_database import HEADINGS, NAMES, OMEGAS, fill, header, result

from hakobune.bem.database import DatabaseError, append, create, extend, open_database, pending, writing
from hakobune.bem.database.file import check_place, check_replaceable, steps_text
from hakobune.bem.database.integrity import crc
from hakobune.bem.database.results import another_version, named, opened_result, schema_of
from hakobune.bem.database.rows import places_on, row_values, same_heading, same_omega


def test_frequencies_and_headings_are_one_within_a_thousand_millionth():
    assert same_omega(0.5 * (1 + 0.9e-9), 0.5) and not same_omega(0.5 * (1 + 1.1e-9), 0.5)
    assert same_omega(0.5 * (1 - 0.9e-9), 0.5) and not same_omega(-0.5, 0.5)
    assert same_heading(0.3 + 0.9e-9, 0.3) and not same_heading(0.3 + 1.1e-9, 0.3)
    assert same_heading(-np.pi, np.pi) and same_heading(0.1 + 4 * np.pi, 0.1) and not same_heading(0.1, 0.1 + np.pi)


def test_places_on_an_axis_are_those_of_its_values():
    axes = {"omega": np.array([0.4, 0.8]), "wave_direction": np.array([0.0, 1.0, 2.0])}
    axes = {name: {(): value} for name, value in axes.items()}
    assert places_on(axes, [0.8, 0.4], "omega") == [1, 0]
    assert places_on(axes, [1.0 - 2 * np.pi, 2.0], "wave_direction") == [1, 2]
    with pytest.raises(DatabaseError, match=r"omega = 0\.6 is not one of the file's 2 values"):
        places_on(axes, [0.6], "omega")


def test_times_of_steps_are_kept_in_480_bytes_or_as_their_sum():
    short = {"a" * 100: 1.0, "b" * 300: 2.5}
    size = len(json.dumps(short))
    whole = {"a" * (100 + 480 - size): 1.0, "b" * 300: 2.5}
    more = {"a" * (100 + 481 - size): 1.0, "b" * 300: 2.5}
    assert len(json.dumps(whole)) == 480 and json.loads(steps_text(whole)) == whole
    assert json.loads(steps_text(more)) == {"total": 3.5}


def test_checksums_are_those_of_all_parts_and_never_zero():
    import zlib

    a, b = np.arange(5.0), np.arange(3)
    assert crc(a, b) == zlib.crc32(b.tobytes(), zlib.crc32(a.tobytes()))
    assert crc() == 1 and crc(np.zeros(0)) == 1


def test_what_a_row_lacks_are_its_quantities_at_the_headings_of_any_of_them(tmp_path):
    path = tmp_path / "box.h5"
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    with writing(path) as file:
        append(file, 0.4, HEADINGS, {**result(0.4, HEADINGS, ["excitation_force"])})
        append(
            file, 0.8, HEADINGS[1:], {**result(0.8, HEADINGS[1:], ["excitation_force", "drift_force", "added_mass"])}
        )
    rows = {row.omega: row for row in pending(path).rows}
    assert rows[0.4].want == {"added_mass", "drift_force", "kochin_radiation"} and rows[0.4].headings == HEADINGS
    assert (
        rows[0.8].want == {"excitation_force", "drift_force", "kochin_radiation"} and rows[0.8].headings == HEADINGS[:1]
    )
    assert rows[1.2].want == {"added_mass", "excitation_force", "drift_force", "kochin_radiation"}
    with h5py.File(path) as file:
        known = row_values(file, 0.8, HEADINGS[1:], ["added_mass", "drift_force"])
        expected = result(0.8, HEADINGS[1:], ["added_mass", "drift_force"])
        np.testing.assert_array_equal(known["added_mass"], expected["added_mass"])
        np.testing.assert_array_equal(known["drift_force"], expected["drift_force"])
        assert row_values(file, 0.8, HEADINGS, ["drift_force"]) is None
        assert (
            row_values(file, 0.4, HEADINGS, ["added_mass"]) is None and row_values(file, 0.4, HEADINGS, ["rao"]) is None
        )


def test_what_is_computed_anew_is_not_taken_over(tmp_path):
    path = tmp_path / "box.h5"
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    fill(path)
    assert extend(path, header=header(scene_hash="other"), anew=("drift_force", "added_mass_infinity"))
    rows, limits = pending(path).rows, pending(path).limits
    assert {row.want for row in rows} == {frozenset({"drift_force"})} and limits == ("added_mass_infinity",)
    db = open_database(path)
    assert db.header.scene_hash == "other" and not len(db.omega)
    fill(path)
    db = open_database(path)
    assert db.complete and np.allclose(db.checks()["energy"], np.array(OMEGAS) / 100)
    assert not extend(path)


def test_what_a_database_is_is_said_in_one_line(tmp_path):
    path = tmp_path / "box.h5"
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    fill(path, limit=2)
    db = open_database(path)
    assert repr(db) == f"<Database box.h5: 2 of 3 frequencies, 2 headings, {', '.join(db.names)}>"
    assert db.asked.tolist() == list(OMEGAS) and not db.holds("added_mass_infinity") and db.holds("drift_force")
    with pytest.raises(DatabaseError, match="lacks added_mass_infinity; repeat the command that made it to continue"):
        db["added_mass_infinity"]
    with pytest.raises(AttributeError, match="a database contains no 'displacement'"):
        _ = db.displacement
    with pytest.raises(DatabaseError, match="contains no 'periods'; it contains: "):
        db["periods"]


def test_hulls_are_round_where_they_are_of_revolution_about_the_origin_and_no_wall_is_beside_them(tmp_path):
    for sizes, scene, symmetry, is_round in (({"radius": 3.0, "draft": 2.0}, "", "xy", True),
                                             ({"length": 3.0}, "", "xy", False),
                                             ({"radius": 3.0, "draft": 2.0}, "wall = 40.0\n", "x", False)):  # fmt: skip
        create(tmp_path / "a.h5", header(dimensions=sizes, scene=scene), OMEGAS, HEADINGS, NAMES)
        db = open_database(tmp_path / "a.h5")
        assert (db.is_round, db.symmetry, db.wall) == (is_round, symmetry, 40.0 if scene else None)
        assert not db.has_viscous_motions
    create(tmp_path / "a.h5", header(scene="[viscous]\nwave_height = 2.0\n"), OMEGAS, HEADINGS, NAMES)
    assert open_database(tmp_path / "a.h5").has_viscous_motions


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write anywhere")
def test_a_folder_without_permission_is_named(tmp_path):
    (tmp_path / "closed").mkdir(mode=0o500)
    with pytest.raises(DatabaseError, match="no permission in"):
        check_place(tmp_path / "closed" / "box.h5")


def test_only_databases_are_replaced(tmp_path):
    path = tmp_path / "box.h5"
    check_replaceable(path)
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    check_replaceable(path)
    content = bytearray(path.read_bytes())
    content[6000] ^= 1
    path.write_bytes(content)
    check_replaceable(path)  # damaged, and it says by its seal what it was
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1.0
    with pytest.raises(DatabaseError, match="is not a hakobune database, so it is not replaced; give another name"):
        check_replaceable(tmp_path / "other.h5")


def test_files_of_other_versions_are_told_with_what_makes_them_anew():
    made = another_version("a.h5", "a file of sweep", 3, 1, "sweep SWEEP --output {} --fresh")
    assert made == (
        "a.h5 is a file of sweep of schema version 3, and this program reads version 1; make it again by "
        "'hakobune sweep SWEEP --output a.h5 --fresh', or read it with the program that wrote it"
    )
    assert "make it again, or read it with the program that wrote it" in another_version("a.h5", "a file", 3, 1, None)
    assert named("hakobune mooring study 1") == "mooring study" and named("other 12") == "other"


def test_a_result_that_is_not_there_or_of_another_kind_is_named(tmp_path):
    with (
        pytest.raises(DatabaseError, match=r"none\.h5 does not exist"),
        opened_result(tmp_path / "none.h5", "hakobune sweep 1"),
    ):
        pass
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.attrs["schema"] = "hakobune response study 1"
    with (
        pytest.raises(DatabaseError, match=r"a\.h5 is a file of response study, and not a file of sweep"),
        opened_result(tmp_path / "a.h5", "hakobune sweep 1"),
    ):
        pass
    assert schema_of(tmp_path / "a.h5") == "hakobune response study 1" and schema_of(tmp_path / "none.h5") == ""
    (tmp_path / "text").write_text("hello")
    assert schema_of(tmp_path / "text") == ""
