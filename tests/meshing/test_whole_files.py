"""Files that arrive whole, or leave what was there."""

import os

import pytest

from hakobune.meshing.whole_files import NotWritten, keep_room, made_beside, not_written, write_whole


def test_texts_and_bytes_are_written_one_after_another_in_place_of_what_was_there(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("before, and longer than what follows")
    write_whole(path, "one é", b"\x00two", "three")
    assert path.read_bytes() == "one é".encode() + b"\x00twothree"
    assert [one.name for one in tmp_path.iterdir()] == ["a.txt"]


def test_a_file_that_fails_while_it_is_made_leaves_what_was_there_and_nothing_beside(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("before")
    said = r"a\.txt cannot be written: No space left on device; the file that was there before is unchanged"
    with pytest.raises(NotWritten, match=said), made_beside(path) as partial:
        assert partial.parent == tmp_path and partial.suffix == ".txt" and partial != path
        partial.write_text("half")
        raise OSError(28, "No space left on device")
    assert path.read_text() == "before" and len(list(tmp_path.iterdir())) == 1


def test_a_part_that_does_not_arrive_is_missed(tmp_path, monkeypatch):
    class Short(str):
        def encode(self):
            return ShortBytes(b"abc")

    class ShortBytes(bytes):
        def __len__(self):
            return 4

    with pytest.raises(NotWritten, match="a part of the file was not written"):
        write_whole(tmp_path / "a.txt", Short("abc"))
    assert not (tmp_path / "a.txt").exists()


def test_a_sparse_file_gets_all_its_bytes_and_keeps_them(tmp_path):
    path = tmp_path / "sparse"
    with path.open("wb") as file:
        file.write(b"begin")
        file.seek(2**20)
        file.write(b"end")
    content = path.read_bytes()
    keep_room(path)
    assert path.read_bytes() == content and path.stat().st_blocks * 512 >= len(content)
    keep_room(tmp_path / "none")
    assert not (tmp_path / "none").exists()
    (tmp_path / "empty").touch()
    keep_room(tmp_path / "empty")
    assert (tmp_path / "empty").stat().st_size == 0


def test_what_cannot_be_kept_is_said_and_what_is_not_ones_own_is_left_alone(tmp_path, monkeypatch):
    path = tmp_path / "a"
    path.write_bytes(b"abc")

    def full(*_):
        raise OSError(28, os.strerror(28))

    def unable(*_):
        raise OSError(95, os.strerror(95))

    monkeypatch.setattr(os, "posix_fallocate", full, raising=False)
    with pytest.raises(NotWritten, match="cannot be written: No space left"):
        keep_room(path)
    monkeypatch.setattr(os, "posix_fallocate", unable, raising=False)
    keep_room(path)  # a file system without it
    assert path.read_bytes() == b"abc"


def test_a_fault_without_a_reason_of_the_system_is_told_in_one_line(tmp_path):
    assert str(not_written("a.h5", OSError("of\nits own"))) == (
        "a.h5 cannot be written: of its own; the file that was there before is unchanged"
    )
