"""Seals of result files: whatever bytes change, the file is not itself any more, and the damaged dataset is named."""

import re

import h5py
import numpy as np
import pytest

from hakobune.bem.database.file import beside
from hakobune.bem.database.integrity import DatabaseError
from hakobune.bem.database.results import opened_result, schema_of
from hakobune.meshing.seals import MARK, damage, is_sealed, write_sealed
from hakobune.meshing.text_files import read_text

SCHEMA = "hakobune made-up study 1"
TEXT = "# a table\n# of two columns\nx,y\n" + "".join(f"{i},{i**2}\n" for i in range(20))


@pytest.fixture
def result(tmp_path):
    path = tmp_path / "result.h5"
    with beside(path) as file:
        file.attrs["schema"] = SCHEMA
        for name in ("first", "group/second", *(f"channel {i}" for i in range(30))):
            file[name] = np.random.default_rng(1).normal(size=50)
    return path


def changed(path, place, to):
    content = bytearray(path.read_bytes())
    assert content[place : place + len(to)] != to
    content[place : place + len(to)] = to
    path.write_bytes(content)


def test_what_was_written_is_read(result):
    assert is_sealed(result) and not damage(result)
    with opened_result(result, SCHEMA) as file:
        assert len(file["first"]) == 50


@pytest.mark.parametrize("name", ["first", "group/second", "channel 7"])
def test_the_damaged_dataset_is_named(result, name):
    with h5py.File(result) as file:
        place = file[name].id.get_offset()  # from the first byte of the block
    changed(result, place + 16, b"damage!!")
    assert damage(result) == name
    with pytest.raises(DatabaseError, match=f"result.h5 is damaged: {name}, by its checksum; copy it again"):
        schema_of(result)


def test_every_byte_counts(result):
    content = result.read_bytes()
    for place in range(0, len(content), 97):
        result.write_bytes(content[:place] + bytes([content[place] ^ 0x10]) + content[place + 1 :])
        assert damage(result), place
    result.write_bytes(content[:-1])
    assert damage(result)


def test_a_terabyte_behind_the_numbers_is_refused_unread(result):
    with result.open("r+b") as file:
        file.truncate(10**12)
    assert damage(result).startswith("its end: it has 1e+12 bytes, its numbers end at ")


def test_a_seal_that_is_gone_is_missed(result):
    changed(result, 0, b"\0" * 64)
    assert damage(result) == "its seal"


def test_files_without_a_seal_are_not_damaged(tmp_path):
    with h5py.File(tmp_path / "plain.h5", "w") as file:
        file["a"] = 1.0
    (tmp_path / "empty").touch()
    for name in ("plain.h5", "empty"):
        assert not is_sealed(tmp_path / name) and not damage(tmp_path / name)
    assert not is_sealed(tmp_path / "none")


def test_a_sealed_text_is_read_whatever_ends_its_lines(tmp_path):
    path = tmp_path / "table.csv"
    write_sealed(path, TEXT)
    found = read_text(path)
    assert re.sub(r"  \[CRC-32 of all else: \w{8}\]", "", found) == TEXT
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    assert read_text(path) == found


def test_a_change_or_a_lost_end_of_a_sealed_text_is_refused(tmp_path):
    path = tmp_path / "table.csv"
    write_sealed(path, TEXT)
    whole = path.read_text()
    for damaged in (whole.replace("\n3,9\n", "\n3,8\n"), whole[:-3], whole.replace("two", "six"), whole + "20,400\n"):
        path.write_text(damaged)
        with pytest.raises(ValueError, match=r"table.csv is damaged: its lines do not match their checksum"):
            read_text(path)
    path.write_text(damaged[: damaged.index(MARK)] + damaged[damaged.index(MARK) + len(MARK) + 9 :])
    assert "20,400" in read_text(path)


def test_a_seal_of_a_text_that_is_damaged_itself_is_no_missing_seal(tmp_path):
    path = tmp_path / "table.csv"
    write_sealed(path, TEXT)
    whole = path.read_text()
    place = whole.index(MARK)
    for first in range(2, place + len(MARK) + 9):
        for new in ("?", "\n", "\n\n\n\n", "abcdef\n"):
            damaged = whole[:first] + new + whole[first + len(new) :]
            if damaged == whole:
                continue
            path.write_text(damaged)
            with pytest.raises(ValueError, match=r"table\.csv is damaged"):
                read_text(path)


def test_words_of_a_seal_in_a_text_without_one_are_words(tmp_path):
    path = tmp_path / "lines.toml"
    path.write_text(
        "# Pretension of all lines, of all else: none; CRC-32 of what follows: 0badcafe]\n[water]\ndepth = 60.0\n"
    )
    assert read_text(path) == path.read_text()
