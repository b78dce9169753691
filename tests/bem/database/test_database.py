"""The database layer alone: numbers are made up here, the solver is not needed."""

import os
import signal
import subprocess
import sys
import time

import h5py
import numpy as np
import pytest

from hakobune.bem.database import (
    DatabaseError,
    Header,
    append,
    append_limit,
    create,
    extend,
    open_database,
    pending,
    writing,
)
from hakobune.bem.database.file import BLOCK, beside, check_replaceable
from hakobune.bem.database.results import has_schema, opened_result
from hakobune.bem.database.schema import CHECKS, DRIFT_DOFS, ERROR, ESTIMATES, QUANTITIES
from hakobune.bem.waves import wavenumber
from hakobune.meshing.panels import PanelMesh

THETA = np.linspace(0, 2 * np.pi, 8, endpoint=False)
OMEGAS = (0.4, 0.8, 1.2)
HEADINGS = (0.0, np.pi / 2)
NAMES = ("added_mass", "excitation_force", "drift_force", "kochin_radiation", "added_mass_infinity")


def header(**changes):
    corners = [[0, 1, 2, 3]]
    mesh = PanelMesh([[0, 0, -1], [0, 1, -1], [1, 1, -1], [1, 0, -1]], corners, "xy", "plate")
    values = dict(
        mesh=mesh,
        lid=mesh.moved(dz=1).flipped(),
        water_depth=20.0,
        density=1025.0,
        gravity=9.80665,
        rotation_center=np.zeros(3),
        theta=THETA,
        body={"center_of_mass": np.array([0.0, 0.0, 1.5]), "hydrostatic_stiffness": np.diag(np.arange(6.0))},
        dimensions={"length": 2.0},
        scene="[water]\ndepth = 20.0\n",
        scene_hash="abc",
    )
    return Header(**{**values, **changes})


def number(name, omega, heading):
    """A number that tells its name, frequency and heading, so that a misplaced row shows."""
    return (1 + list(QUANTITIES).index(name)) * (omega + 1000 * round(heading, 6))


def result(omega, headings, names):
    made = {"checks": {"energy": omega / 100}, "wall_time": {"factor": 0.25}, "estimated_error": {}}
    for name in names:
        axes, _, kind = QUANTITIES[name]
        if "omega" not in axes:
            continue
        rest = {"theta": len(THETA), "drift_dof": 3}
        shape = [rest.get(axis, 6) for axis in axes if axis not in ("omega", "wave_direction")]
        if "wave_direction" in axes:
            value = np.array([np.full(shape, number(name, omega, b), kind) for b in headings])
        else:
            value = np.full(shape, number(name, omega, 0), kind)
        made[name] = value * (1 + 2j) if kind is complex else value
        if name in ESTIMATES:
            made["estimated_error"][name] = (value.real / 1000).astype(ERROR).astype(float)
    return made


def fill(path, limit=None):
    todo = pending(path)
    with writing(path) as file:
        for row in todo.rows[:limit]:
            append(file, row.omega, row.headings, result(row.omega, row.headings, row.want))
        if limit is None:
            for name in todo.limits:
                append_limit(file, name, np.full((6, 6), 7.0))


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "box.h5"
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    return path


def assert_right(path, omegas, headings, names):
    db = open_database(path)
    assert np.allclose(db.omega, omegas)
    assert np.allclose(db.wave_direction, headings)
    for name in names:
        value = db[name]
        if "omega" not in QUANTITIES[name][0]:
            continue
        for i, w in enumerate(db.omega):
            made = result(w, db.wave_direction, [name])
            np.testing.assert_array_equal(value[i], made[name], err_msg=name)
            for estimated, error in made["estimated_error"].items():
                np.testing.assert_array_equal(db.estimated_errors()[estimated][i], error, err_msg=name)


def test_what_was_appended_is_read_back(path):
    fill(path)
    assert_right(path, OMEGAS, HEADINGS, NAMES)
    db = open_database(path)
    assert db.complete and not pending(path).rows and not pending(path).limits
    assert db.water_depth == 20.0 and db.density == 1025.0 and db.dimensions == {"length": 2.0}
    np.testing.assert_array_equal(db.center_of_mass, [0, 0, 1.5])
    np.testing.assert_array_equal(db.hydrostatic_stiffness, np.diag(np.arange(6.0)))
    assert db.inertia_matrix is None
    np.testing.assert_array_equal(db.mesh.points, header().mesh.points)
    np.testing.assert_array_equal(db.lid.corners, header().lid.corners)
    np.testing.assert_allclose(db.checks()["energy"], np.array(OMEGAS) / 100)
    assert db.wall_times()[0] == {"factor": 0.25}
    np.testing.assert_allclose(db["wavenumber"], wavenumber(OMEGAS, 20.0))
    np.testing.assert_allclose(db["period"], 2 * np.pi / np.array(OMEGAS))


def test_errors_are_kept_for_what_is_there_and_absent_where_there_is_no_estimate(path):
    todo = pending(path).rows
    with writing(path) as file:
        for row in todo:
            made = result(row.omega, row.headings, row.want)
            if row.omega == OMEGAS[1]:
                del made["estimated_error"]
            append(file, row.omega, row.headings, made)
    errors = open_database(path).estimated_errors()
    assert set(errors) == {"added_mass", "excitation_force", "drift_force"}
    assert errors["excitation_force"].shape == (3, 2, 6) and errors["added_mass"].dtype == float
    for error in errors.values():
        assert np.isnan(error[1]).all() and np.isfinite(error[[0, 2]]).all()


def unsealed(path):
    """The file without the block that holds its seal"""
    path.write_bytes(path.read_bytes()[BLOCK:])


def made_before_checksums(path):
    """The file as it was made before there were any: marks of one byte"""
    with h5py.File(path, "r+") as file:
        del file["row_checksum"]
        for name in list(file["stored"]):
            marks = (file["stored"][name][()] != 0).astype(np.uint8)
            del file["stored"][name]
            file["stored"][name] = marks
    unsealed(path)


def test_a_file_without_estimated_errors_is_read_finished_and_extended(path):
    made_before_checksums(path)
    with h5py.File(path, "r+") as file:
        del file["estimated_error"]
    fill(path)
    db = open_database(path)
    assert db.complete and all(np.isnan(error).all() for error in db.estimated_errors().values())
    assert db.estimated_errors()["excitation_force"].shape == (3, 2, 6)
    assert extend(path, omega=(0.6,))
    fill(path)
    error = open_database(path).estimated_errors()["added_mass"]
    assert np.isfinite(error[1]).all() and np.isnan(error[[0, 2, 3]]).all()


def test_a_file_with_checksums_but_no_estimated_errors_of_drift_is_read_and_extended(path):
    with h5py.File(path, "r+") as file:
        del file["estimated_error/drift_force"]
    unsealed(path)
    fill(path)
    db = open_database(path)
    errors = db.estimated_errors()
    assert db.complete and np.isfinite(errors["added_mass"]).all()
    assert np.isnan(errors["drift_force"]).all() and errors["drift_force"].shape == (3, 2, 3)
    assert extend(path, omega=(0.6,))
    fill(path)
    error = open_database(path).estimated_errors()["drift_force"]
    assert np.isfinite(error[1]).all() and np.isnan(error[[0, 2, 3]]).all()


def test_infinite_depth_survives(tmp_path):
    create(tmp_path / "deep.h5", header(water_depth=np.inf), OMEGAS, HEADINGS, NAMES)
    assert np.isinf(open_database(tmp_path / "deep.h5").water_depth)


def test_rows_come_in_ascending_frequency_whatever_order_they_were_solved_in(path):
    rows = pending(path).rows
    with writing(path) as file:
        for row in (rows[2], rows[0]):
            append(file, row.omega, row.headings, result(row.omega, row.headings, row.want))
    assert_right(path, (0.4, 1.2), HEADINGS, ("added_mass", "drift_force"))
    assert [row.omega for row in pending(path).rows] == [0.8]


def test_more_frequencies_leave_only_these_pending(path):
    fill(path)
    assert extend(path, omega=(0.4, 0.6, 2.0))
    with h5py.File(path) as file:
        assert file["solved"][()].tolist() == [1, 0, 1, 1, 0]
        assert file["omega"].attrs["NAME"] == b"omega" and file["theta"].attrs["NAME"] == b"theta"
    assert [row.omega for row in pending(path).rows] == [0.6, 2.0]
    assert_right(path, OMEGAS, HEADINGS, NAMES)
    fill(path)
    assert_right(path, (0.4, 0.6, 0.8, 1.2, 2.0), HEADINGS, NAMES)


def test_more_headings_leave_only_these_and_nothing_of_radiation_pending(path):
    fill(path)
    assert extend(path, wave_direction=(np.pi / 4,))
    for row in pending(path).rows:
        assert row.want == {"excitation_force", "drift_force"}
        np.testing.assert_allclose(row.headings, [np.pi / 4])
    fill(path)
    assert_right(path, OMEGAS, (0, np.pi / 4, np.pi / 2), NAMES)


def test_another_quantity_leaves_only_it_pending(path):
    fill(path)
    assert extend(path, names=("rao", "added_mass_zero"))
    assert all(row.want == {"rao"} for row in pending(path).rows)
    assert pending(path).limits == ("added_mass_zero",)
    fill(path)
    assert_right(path, OMEGAS, HEADINGS, (*NAMES, "rao"))


def test_asking_again_for_the_same_changes_nothing(path):
    fill(path)
    before = path.read_bytes()
    rounded = np.array(OMEGAS) * (1 + 1e-13)
    assert not extend(path, omega=rounded, wave_direction=(2 * np.pi, -1.5 * np.pi), names=NAMES)
    assert path.read_bytes() == before


def test_half_a_row_is_not_shown(path):
    with writing(path) as file:
        append(file, 0.4, HEADINGS[:1], result(0.4, HEADINGS[:1], NAMES))
    with pytest.raises(DatabaseError, match="no solved frequency yet"):
        open_database(path)["added_mass"]
    assert pending(path).rows[0].want == {"excitation_force", "drift_force"}
    assert pending(path).rows[0].headings == HEADINGS[1:]


def test_a_result_that_is_not_finite_is_not_marked(path):
    broken = result(0.4, HEADINGS, NAMES)
    broken["drift_force"][1, 2] = np.nan
    with (
        writing(path) as file,
        pytest.raises(DatabaseError, match=r"drift_force at .* is not finite"),
    ):
        append(file, 0.4, HEADINGS, broken)
    assert len(pending(path).rows) == len(OMEGAS)


def test_one_number_that_is_infinite_or_of_another_shape_or_type_is_refused_with_its_place(path):
    for value, words in ((np.inf, "excitation_force at omega = 0.4 rad/s is not finite"), (1.0, "")):
        given = result(0.4, HEADINGS, NAMES)
        given["excitation_force"][0, 3] = value
        with writing(path) as file:
            if words:
                with pytest.raises(DatabaseError, match=words):
                    append(file, 0.4, HEADINGS, given)
            else:
                append(file, 0.4, HEADINGS, given)
    more = result(0.8, HEADINGS, NAMES)
    for wrong, words in ((more["added_mass"][:5], r"added_mass at omega = 0\.8 rad/s has shape \(5, 6\); allowed: "),
                         (1j * more["added_mass"], "added_mass at .* is complex, its type is real")):  # fmt: skip
        with writing(path) as file, pytest.raises(DatabaseError, match=words):
            append(file, 0.8, HEADINGS, more | {"added_mass": wrong})


def test_limits_may_be_infinite_but_not_nan(path):
    with writing(path) as file:
        append_limit(file, "added_mass_infinity", np.full((6, 6), np.inf))
        with pytest.raises(DatabaseError, match="not finite"):
            append_limit(file, "added_mass_infinity", np.full((6, 6), np.nan))


def test_a_missing_quantity_is_named_with_the_way_to_add_it(path):
    fill(path)
    db = open_database(path)
    with pytest.raises(DatabaseError, match=r"contains no drift_force_fixed; .*--only drift_force_fixed"):
        db.require("added_mass", "drift_force_fixed")
    with pytest.raises(DatabaseError, match=r"contains no rao; .*--gyration"):
        db["rao"]
    with pytest.raises(DatabaseError, match="'drfit' is not a quantity of a database"):
        db.require("drfit")


def test_xarray_shows_labelled_data_with_units(path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    fill(path)
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        for name in NAMES:
            axes, unit, kind = QUANTITIES[name]
            assert data[name].dims == axes
            assert data[name].attrs["units"] == unit
            assert np.iscomplexobj(data[name].values) == (kind is complex)
        assert list(data["radiating_dof"].values) == ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]
        assert list(data["drift_dof"].values) == list(DRIFT_DOFS)
        heave = data["added_mass"].sel(omega=0.8, influenced_dof="Heave", radiating_dof="Heave")
        assert float(heave) == number("added_mass", 0.8, 0)
        assert data.attrs["water_depth"] == 20.0
    with xarray.open_dataset(path, engine="h5netcdf", group="checks") as data:
        assert set(CHECKS) <= set(data)
        assert data["energy"].dims == ("omega",)
    with xarray.open_dataset(path, engine="h5netcdf", group="estimated_error") as data:
        axes, unit, _ = QUANTITIES["excitation_force"]
        assert data["excitation_force"].dims == axes and data["excitation_force"].attrs["units"] == unit
    with xarray.open_dataset(path, engine="h5netcdf", group="mesh") as data:
        assert data["points"].attrs["units"] == "m"


def foreign_netcdf(path):
    with h5py.File(path, "w") as file:
        file["x"] = 1.0


def study(path):
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = "hakobune mooring study 1"


def other_version(path):
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    unsealed(path)
    with h5py.File(path, "r+") as file:
        file.attrs["schema_version"] = 99


def other_version_in_its_seal(path):
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    with h5py.File(path, "r+") as file:
        file.attrs["schema_version"] = 2


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda path: path.write_text("length,beam\n"), "is not an HDF5 file"),
        (lambda path: path.write_bytes(b""), "is not an HDF5 file"),
        (foreign_netcdf, "HDF5 file of another program"),
        (study, "is a file of mooring study, not a hakobune database"),
        (
            other_version,
            "a database of schema version 99, and this program reads version 1; make it again by 'hakobune solve",
        ),
        (other_version_in_its_seal, "of schema version 2, and this program reads version 1"),
        (lambda path: path.mkdir(), "is not a file"),
        (lambda path: None, "does not exist"),
    ],
)
def test_a_foreign_file_gives_one_line_and_is_left_alone(tmp_path, make, says):
    path = tmp_path / "other.h5"
    make(path)
    before = path.read_bytes() if path.is_file() else None
    for use in (open_database, pending, lambda p: extend(p, omega=(9.0,))):
        with pytest.raises(DatabaseError, match=says) as caught:
            use(path)
        assert "\n" not in str(caught.value) and str(path) in str(caught.value)
    assert (path.read_bytes() if path.is_file() else None) == before
    assert [p.name for p in tmp_path.iterdir()] == ([path.name] if path.exists() else [])


@pytest.mark.parametrize("content", [b"", b"length,beam\n"])
def test_a_file_that_is_not_replaced_keeps_its_bytes(tmp_path, content):
    path = tmp_path / "other.h5"
    path.write_bytes(content)
    with pytest.raises(DatabaseError, match="is not replaced; give another name"):
        check_replaceable(path)
    assert path.read_bytes() == content


def test_a_path_that_cannot_be_written_is_named(tmp_path):
    with pytest.raises(DatabaseError, match="cannot be written: the folder"):
        create(tmp_path / "nowhere" / "box.h5", header(), OMEGAS, HEADINGS, NAMES)
    with pytest.raises(DatabaseError, match="is a folder"):
        create(tmp_path, header(), OMEGAS, HEADINGS, NAMES)


def test_nothing_is_left_behind_when_making_a_file_fails(tmp_path):
    with pytest.raises(Exception):  # noqa: B017 - any fault inside counts
        create(tmp_path / "box.h5", header(theta="east"), OMEGAS, HEADINGS, NAMES)
    assert list(tmp_path.iterdir()) == []


def test_two_writers_exclude_each_other(path):
    code = f"from hakobune.bem.database import writing\nwith writing({str(path)!r}): pass"
    with writing(path):
        other = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert other.returncode and "another process has opened it" in other.stderr.splitlines()[-1]


WRITER = """
import sys
sys.path.insert(0, {folder!r})
from test_database import NAMES, append, extend, fill, pending, result, writing
path = {path!r}
print("go", flush=True)
while True:
    extend(path, omega=[row + 1e-3 for row in {omegas!r}], wave_direction=[0.3, 0.7])
    fill(path)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
def test_a_killed_writer_leaves_a_file_that_opens_and_can_be_finished(tmp_path):
    many = tuple(np.round(np.linspace(0.2, 2.0, 10), 6).tolist())
    delays = np.random.default_rng(3).uniform(0.0, 0.25, 6)
    code = WRITER.format(folder=os.path.dirname(__file__), path=str(tmp_path / "box.h5"), omegas=many)
    for delay in delays:
        path = tmp_path / "box.h5"
        create(path, header(), many, HEADINGS, NAMES)
        writer = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        assert writer.stdout.readline() == b"go\n"
        time.sleep(delay)
        writer.send_signal(signal.SIGKILL)
        writer.wait()
        db = open_database(path)
        if len(db.omega):
            assert_right(path, db.omega, db.wave_direction, ("added_mass", "excitation_force", "drift_force"))
        fill(path)
        assert open_database(path).complete
        assert_right(path, open_database(path).omega, db.wave_direction, NAMES)


def test_an_open_file_is_read_and_widened_as_by_its_name(tmp_path):
    path = tmp_path / "box.h5"
    create(path, header(), OMEGAS, HEADINGS, NAMES)
    fill(path, limit=2)
    with writing(path) as file:
        assert pending(file) == pending(path)
        assert not extend(file, omega=[])
        db = open_database(file)
        assert (
            db.path == path
            and len(db.omega) == 2
            and np.array_equal(db["added_mass"], open_database(path)["added_mass"])
        )
    assert np.isfinite(db["added_mass"]).all()  # its file is closed, and opened again
    with writing(path) as file:
        assert extend(file, omega=[1.7])
    assert 1.7 in [row.omega for row in pending(path).rows]


@pytest.mark.parametrize(
    ("version", "says"),
    [
        (2, None),
        (
            7,
            "of schema version 7, and this program reads version 2; make it again",
        ),
    ],
)
@pytest.mark.parametrize("sealed", [True, False])
def test_a_result_of_another_version_is_told_as_that_and_may_be_replaced(tmp_path, version, says, sealed):
    """Written by a program of that version, or its attribute changed behind its seal"""
    path, ours = tmp_path / "study.h5", "hakobune mooring study 2"
    with beside(path) as file:
        file.attrs["schema"] = f"hakobune mooring study {version}" if sealed else ours
    if not sealed:
        with h5py.File(path, "r+") as file:
            file.attrs["schema"] = f"hakobune mooring study {version}"
    if sealed:
        assert has_schema(path, ours) and not has_schema(path, "hakobune response study 1")
    if says is None and sealed:
        with opened_result(path, ours) as file:
            assert file.attrs["schema"] == ours
        return
    with pytest.raises(DatabaseError, match=says or "is damaged") as fault, opened_result(path, ours):
        pass
    assert ("damaged" in str(fault.value)) == (says is None) and "\n" not in str(fault.value)
