"""A disk that is full, or a limit on the size of files: one line, status 2, and what was there before."""

import os
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest
from forked import ended

from hakobune.meshing.whole_files import NotWritten, keep_room
from hakobune.pipelines.cli import main

resource = pytest.importorskip("resource")

SCENES = Path(__file__).parents[3] / "pipelines" / "scenes"
BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 60 --gyration 15.6,29.4,32.3 --heading 0,210,240"
SEA = "sea --height 3 --mean-period 8 --duration 600"
SECTIONS = "sections --beam-draft 5 --depth-draft 2 --xi 1 --tolerance 1e-3"
# command, its output, bytes a file may have
COMMANDS = [
    (f"{BOX} --omega 0.5,1 --output new.h5", "new.h5", 8192),
    (f"{BOX} --omega 0.3,0.45,0.6,0.9,1.1 --output box.h5", "box.h5", 8192),
    (f"{BOX} --omega 0.5 --mesh-only --output new.gdf", "new.gdf", 100),
    (f"{SEA} --record waves.csv", "waves.csv", 4096),
    ("sea --height 3 --mean-period 8 --output spectrum.csv", "spectrum.csv", 100),
    ("sea --height 3 --mean-period 8 --plot sea.png", "sea.png", 4096),
    (f"{SECTIONS} --output sections.csv", "sections.csv", 100),
    (f"{SECTIONS} --output sections.h5", "sections.h5", 1000),
    ("response response_box_20m.toml --database box.h5 --output response.csv", "response.csv", 100),
    ("response response_box_20m.toml --database box.h5 --output response.h5", "response.h5", 4096),
    ("plot box.h5 --output box.png", "box.png", 4096),
]


def ran(words, folder, limit):
    """status and what was said by a command that may write `limit` bytes into a file"""
    words = [str(SCENES / word) if (SCENES / word).is_file() else word for word in shlex.split(words)]

    def work():
        os.chdir(folder)
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
        return main(words)

    done = ended(work)
    return done.status, done.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("disk")
    # compiled before a limit keeps the compiler from storing what it makes
    for words in (f"{BOX} --omega 0.3,0.45,0.6,0.9 --output box.h5", f"{SECTIONS} --output before.csv"):
        status, said = ran(words, made, -1)
        assert status == 0, said
    return made


@pytest.mark.parametrize(("words", "output", "limit"), COMMANDS)
def test_a_limit_on_the_size_of_files_gives_one_line_and_leaves_what_was_there(folder, words, output, limit):
    before = {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}
    status, said = ran(words, folder, limit)
    lines = [line for line in said.splitlines() if "cannot be written" in line]
    assert status == 2 and len(lines) == 1 and output in lines[0] and "Traceback" not in said, (status, said)
    assert {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()} == before


@pytest.fixture
def full(folder, tmp_path):
    """A folder on a disk of 1 MB with a database in it"""
    mount = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", tmp_path], capture_output=True, check=False
    )
    if mount.returncode:
        pytest.skip("no file system can be mounted here")
    try:
        shutil.copy(folder / "box.h5", tmp_path)
        yield tmp_path
    finally:
        subprocess.run(["umount", "-l", tmp_path], check=True)


def fill(disk, room):
    """Leave `room` bytes on it"""
    free = shutil.disk_usage(disk).free
    (disk / "filling").write_bytes(b"x" * max(0, free - room))


@pytest.mark.parametrize(
    ("words", "output"),
    [
        (f"{BOX} --omega 0.5,1 --output new.h5", "new.h5"),
        (f"{BOX} --omega 0.3,0.45,0.6,0.9,1.1 --output box.h5", "box.h5"),
        ("moor moor_chain_12.toml --database box.h5 --output moor.h5", "moor.h5"),
        ("lines lines_barge.toml --output lines.h5", "lines.h5"),
    ],
)
def test_a_full_disk_gives_one_line_and_leaves_what_was_there(full, words, output):
    fill(full, 4096)
    before = {path.name: path.read_bytes() for path in full.iterdir()}
    status, said = ran(words, full, -1)
    lines = [line for line in said.splitlines() if "cannot be written" in line]
    assert status == 2 and len(lines) == 1 and output in lines[0] and "Traceback" not in said, (status, said)
    assert {path.name: path.read_bytes() for path in full.iterdir()} == before
    (full / "filling").unlink()
    assert ran(words, full, -1)[0] == (1 if words.startswith("moor ") else 0)  # whose lines part


def test_a_sparse_copy_on_a_full_disk_is_not_written_into(full):
    """Its holes have no room on the disk, although no file grows."""
    sparse = full / "sparse.h5"
    os.truncate(full / "box.h5", 0)
    with sparse.open("wb") as file:
        file.truncate(200_000)
    fill(full, 0)
    with pytest.raises(NotWritten, match=r"sparse\.h5 cannot be written: No space left"):
        keep_room(sparse)
