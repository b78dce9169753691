"""What is said of files that cannot be opened or written, and of values that cannot be stored."""

import errno
import subprocess
import sys

import h5py
import numpy as np
import pytest

from hakobune.bem.database import DatabaseError
from hakobune.bem.database import file as files
from hakobune.bem.database.storing import checked
from hakobune.bem.database.widening import content

BUSY = "another process has opened it; wait until it ends, or give another file"


@pytest.mark.parametrize("error, says", [
    (OSError(errno.EAGAIN, "no"), BUSY),
    (OSError(35, "no"), BUSY),
    (OSError("Unable to open: unable to lock file"), BUSY),
    (OSError("Unable to open: truncated file: eof = 96"), "the file is truncated; copy it again, or give another name"),
    (OSError(errno.EACCES, "no"), "Permission denied"), (OSError("bad signature\nmore"), "bad signature"),
])  # fmt: skip
def test_a_reason_is_in_words(error, says):
    assert files._reason(error) == says


@pytest.mark.parametrize("error, kind, says", [
    (OSError("Can't synchronously read data (bad checksum)\nmore"), files.DamagedError,
     "is damaged: Can't synchronously read data (bad checksum); "),
    (RuntimeError("Unable to get link (not found)"), files.DamagedError, "is damaged: Unable to get link"),
    (OSError(errno.ENOSPC, "no"), OSError, ""), (RuntimeError("no brackets"), RuntimeError, "no brackets"),
    (KeyError("synchronously gone"), files.DamagedError, "is damaged: synchronously gone"), (KeyError(), KeyError, ""),
    (RuntimeError("Can't synchronously write data (disk full)"), files.NotWritten,
     "a.h5 cannot be written: Can't synchronously write data (disk full); the data stored before is kept"),
])  # fmt: skip
def test_what_hdf5_says_of_damage_is_one_line(error, kind, says):
    with pytest.raises(kind) as told, files.damage_named("a.h5"):
        raise error
    assert says in str(told.value) and "more" not in str(told.value)


def test_an_error_of_the_system_while_writing_is_named(monkeypatch):
    class Full(OSError):
        def __init__(self):
            super().__init__("Can't synchronously write data")
            self.errno = errno.ENOSPC

    with (
        pytest.raises(files.NotWritten, match="cannot be written: No space left on device"),
        files.damage_named("a.h5"),
    ):
        raise Full


@pytest.mark.parametrize("name, value, shape, infinite, says", [
    ("added_mass", np.ones((6, 6)) * 1j, (6, 6), False, "added_mass at ω is complex, its type is real"),
    ("added_mass", np.ones((6, 5)), (6, 6), False, "added_mass at ω has shape (6, 5); allowed: (6, 6)"),
    ("added_mass", np.full((6, 6), np.nan), (6, 6), True, "added_mass at ω is not finite"),
    ("added_mass", np.full((6, 6), np.inf), (6, 6), False, "added_mass at ω is not finite"),
    ("added_mass", np.full((6, 6), np.inf), (6, 6), True, ""), ("rao", np.ones((2, 6)), (2, 6), False, ""),
    ("added_mass", np.ones((6, 6)), (6, 6), False, ""),
])  # fmt: skip
def test_values_have_the_type_and_shape_of_their_quantity_and_are_finite(name, value, shape, infinite, says):
    if says:
        with pytest.raises(DatabaseError) as told:
            checked(name, value, shape, "ω", infinite)
        assert says in str(told.value)
    else:
        found = checked(name, value, shape, "ω", infinite)
        assert np.array_equal(found, value) and found.dtype == (complex if name == "rao" else float)


def test_a_group_has_axes_first_and_without_them_it_is_damaged(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        group = file.create_group("forces")
        for name, axes in (("a", "omega"), ("omega", "omega")):
            made = group.create_dataset(name, data=np.arange(3.0))
            made.attrs["axes"] = axes
        group["a"].attrs["units"] = "N"
        group.attrs["kind"] = "sums"
        datasets, attributes = content(file, "forces")
        assert list(datasets) == ["omega", "a"] and datasets["a"][:2] == (("omega",), "N")
        assert datasets["omega"][1] == "" and attributes == {"kind": "sums"} and content(file, "other") is None
        del group["a"].attrs["axes"]
        with pytest.raises(DatabaseError, match=r"a\.h5 is damaged: forces: .*; compute this group of results again"):
            content(file, "forces")


def test_a_file_that_another_process_writes_is_named_with_the_way_out(tmp_path):
    path = tmp_path / "a.h5"
    hold = f"import h5py\nwith h5py.File({str(path)!r}, 'w'): print('open', flush=True), input()"
    with subprocess.Popen([sys.executable, "-c", hold], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        assert other.stdout.readline() == b"open\n"
        for mode in ("r", "r+"):
            with pytest.raises(DatabaseError, match=rf"a\.h5 cannot be opened: {BUSY}"), files.unlocked(path, mode):
                pass
        other.communicate(b"\n")
    with files.unlocked(path, "r+") as file:
        file["x"] = 1.0
