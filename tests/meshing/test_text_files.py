"""Text files of other programs."""

import gzip
import io
import os

import pytest

from hakobune.meshing.text_files import csv_rows, numbers_of, read_text


def test_a_byte_order_mark_and_windows_line_ends_are_not_text(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b'\xef\xbb\xbfa = 1\r\nb = "\xc3\xa9"\r\n')
    assert read_text(path) == 'a = 1\nb = "é"\n'


def test_what_is_no_text_file_is_refused_by_name(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "binary").write_bytes(b"\xff\xfe\x00")
    (tmp_path / "large").write_bytes(b"x" * 2_000_000)
    for path, what in [
        (tmp_path / "pipe", "a device or a pipe"),
        ("/dev/zero", "a device or a pipe"),
        (tmp_path / "binary", "not text"),
        (tmp_path / "large", "has 2 MB; allowed: up to 1 MB"),
        (tmp_path / "none", "does not exist"),
        (tmp_path, "Is a directory"),
    ]:
        with pytest.raises(KeyError, match=what):
            read_text(path, KeyError, largest=1)


def test_numbers_at_the_head_of_a_line_are_read_as_fortran_reads_them():
    assert numbers_of("1.D0, 2 -3d-1  4e2 metres 5") == [1.0, 2.0, -0.3, 400.0]
    assert numbers_of("HBOT 20") == numbers_of("") == []


def test_what_is_packed_in_a_file_is_read_up_to_its_limit_and_refused_beyond(tmp_path):
    path = tmp_path / "a.txt.gz"
    for size, whole in ((1_000_000, True), (1_000_001, False)):
        with gzip.open(path, "w") as file:
            file.write(b"x" * size)
        if whole:
            assert len(read_text(path, largest=1)) == size
        else:
            with pytest.raises(KeyError, match="has more than 1 MB unpacked"):
                read_text(path, KeyError, largest=1)


def test_rows_of_a_table_are_its_lines_without_remarks_and_blanks():
    text = "# made by hand\n\n  \nname,value\n\t\n  # a remark\na,1\n   \nb,2 # not one\n"
    assert list(csv_rows(text)) == [{"name": "a", "value": "1"}, {"name": "b", "value": "2 # not one"}]


def test_no_more_of_a_packed_file_is_unpacked_than_shows_that_it_is_too_large(monkeypatch, tmp_path):
    """A file of a few kilobytes may hold gigabytes"""
    asked = []

    class Endless(io.BytesIO):
        def read(self, count=-1):
            asked.append(count)
            return b"x" * count

    monkeypatch.setattr(gzip, "open", lambda path: Endless())
    (tmp_path / "a.txt.gz").write_bytes(b"few")
    with pytest.raises(ValueError, match=r"a\.txt\.gz has more than 3 MB unpacked; allowed: up to that"):
        read_text(tmp_path / "a.txt.gz", largest=3)
    assert asked == [3_000_001]
