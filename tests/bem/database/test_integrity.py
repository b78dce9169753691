"""A database knows when it is not itself any more."""

import h5py
import numpy as np
import pytest
from test_database import HEADINGS, NAMES, OMEGAS, fill, header, made_before_checksums, unsealed

from hakobune.bem.database import DatabaseError, create, extend, open_database, pending, writing
from hakobune.bem.database.file import LATER
from hakobune.bem.database.integrity import repair


@pytest.fixture
def path(tmp_path):
    create(tmp_path / "box.h5", header(), OMEGAS, HEADINGS, NAMES)
    fill(tmp_path / "box.h5")
    return tmp_path / "box.h5"


def everything(path):
    """Whatever a reader may ask for"""
    db = open_database(path)
    values = {name: db[name] for name in db.names}
    return [values, db.checks(), db.wall_times(), db.estimated_errors(), db.mesh.points, db.omega, db.wave_direction]


def tampered(path, name, change):
    with h5py.File(path, "r+") as file:
        change(file, name)


def doubled(file, name):
    file[name][...] = 2 * file[name][()]


def one_less(file, name):
    data = file[name][()][..., :-1] if file[name].ndim else 0.0
    attributes = dict(file[name].attrs)
    del file[name], attributes
    file[name] = data


def of_another_type(file, name):
    data = file[name][()]
    del file[name]
    file[name] = data.real if data.dtype.kind == "c" else data + 0j


def gone(file, name):
    del file[name]


def attribute(value):
    def change(file, name):
        file.attrs[name] = value

    return change


def reversed_order(file, name):
    file[name][...] = file[name][()][::-1]


@pytest.mark.parametrize(
    ("name", "change"),
    [
        *(
            (name, doubled)
            for name in ("added_mass", "excitation_force", "checks/energy", "estimated_error/added_mass")
        ),
        *((name, doubled) for name in ("omega", "mesh/points", "added_mass_infinity")),
        *(
            (name, gone)
            for name in (
                "omega",
                "wave_direction",
                "checks",
                "mesh",
                "stored/added_mass",
                "added_mass",
                "estimated_error",
                "wall_time",
            )
        ),
        *((name, one_less) for name in ("omega", "added_mass", "checks/energy", "theta")),
        *((name, of_another_type) for name in ("added_mass", "excitation_force", "omega")),
        ("omega", reversed_order),
        ("wave_direction", reversed_order),
        *((name, attribute(value)) for name, value in (("density", np.nan), ("scene", "garbage"), ("gravity", 32.2))),
        ("water_depth", attribute("deep")),
    ],
)
def test_what_was_changed_is_refused_in_one_line_that_names_it(path, name, change):
    tampered(path, name, change)
    with pytest.raises(DatabaseError, match=r"is damaged: [^\n]*$") as fault:
        everything(path)
    assert "--repair" in str(fault.value) or "--fresh" in str(fault.value)
    with pytest.raises(DatabaseError, match="is damaged"), writing(path):
        pass


@pytest.mark.parametrize(
    ("name", "change"),
    [("omega", reversed_order), ("density", attribute(np.nan)), ("added_mass", one_less), ("checks", gone)],
)
def test_a_file_from_before_there_were_checksums_is_held_to_the_schema(path, name, change):
    before = everything(path)
    made_before_checksums(path)
    np.testing.assert_equal(everything(path), before)
    tampered(path, name, change)
    with pytest.raises(DatabaseError, match="is damaged"):
        everything(path)


def test_a_number_that_is_not_finite_is_no_number_in_any_file(path):
    made_before_checksums(path)
    tampered(path, "added_mass", lambda file, name: file[name].__setitem__((1, 0, 0), np.inf))
    with pytest.raises(DatabaseError, match=rf"added_mass at ω = {sorted(OMEGAS)[1]:.4g} rad/s"):
        open_database(path)["added_mass"]


def test_widening_keeps_the_checksums_and_gives_them_to_files_that_had_none(path):
    made_before_checksums(path)
    assert extend(path, omega=(0.6,))
    tampered(path, "added_mass", lambda file, name: file[name].__setitem__((0, 0, 0), 1.0))
    with pytest.raises(DatabaseError, match="added_mass"):
        everything(path)


def test_what_is_repaired_is_pending_and_the_rest_as_it_was(path):
    before = open_database(path)["added_mass"]
    tampered(path, "added_mass", lambda file, name: file[name].__setitem__((1, 2, 2), 1.0))
    with h5py.File(path, "r+") as file:
        assert repair(file) == {"added_mass": 1}
    rows = pending(path).rows
    assert [(row.omega, row.want) for row in rows] == [(sorted(OMEGAS)[1], {"added_mass"})]
    np.testing.assert_array_equal(open_database(path)["added_mass"], before[[0, 2]])
    with h5py.File(path, "r+") as file:
        assert repair(file) == {}


def test_a_mark_that_is_lost_costs_work_and_nothing_else(path):
    tampered(path, "stored/added_mass", lambda file, name: file[name].__setitem__(1, 0))
    assert len(pending(path).rows) == 1 and len(open_database(path).omega) == 2
    fill(path)
    assert open_database(path).complete


def test_a_coordinate_larger_than_its_file_is_refused_before_it_is_read(path):
    with h5py.File(path, "r+") as file:
        del file["theta"]
        file.create_dataset("theta", shape=(10**12,), dtype=float)
    unsealed(path)
    with pytest.raises(DatabaseError, match="theta is larger than the file; copy it again"):
        open_database(path)


def test_no_byte_that_hdf5_goes_by_is_read_before_it_is_known_to_be_whole(path):
    content, right = path.read_bytes(), everything(path)
    places = []

    def add(name, item):
        if isinstance(item, h5py.Dataset) and (name in LATER or name.partition("/")[0] in LATER):
            places.append((item.id.get_offset(), item.id.get_storage_size()))

    with h5py.File(path) as file:
        file.visititems(add)
    later = {place for first, count in places for place in range(first, first + count)}
    for place in (place for place in range(0, len(content), 61) if place not in later):
        path.write_bytes(content[:place] + bytes([content[place] ^ 0x24]) + content[place + 1 :])
        with pytest.raises(DatabaseError, match="is damaged"):
            open_database(path)
    path.write_bytes(content)
    np.testing.assert_equal(everything(path), right)
