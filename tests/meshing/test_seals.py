"""Seals of result files: whatever bytes change, the file is not itself any more, and the damaged dataset is named."""

import re
import zlib

import h5py
import numpy as np
import pytest

from hakobune.bem.database.file import beside
from hakobune.bem.database.integrity import DatabaseError
from hakobune.bem.database.results import opened_result, schema_of
from hakobune.meshing.seals import (
    MARK,
    SIGNATURE,
    damage,
    hdf5_seal,
    is_sealed,
    kind_filled_in,
    text_sealed,
    write_sealed,
)
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
    assert damage(result).startswith("its end: the file has 1e+12 bytes, but its numbers end at ")


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


def test_a_seal_is_the_crc_of_every_byte_after_its_first_line_and_of_each_dataset():
    """By zlib, line by line; 512 bytes, or twice as many until its table has room"""
    image = SIGNATURE + bytes(range(256)) * 4
    places = {"a": (8, 100), "group/b": (300, 50)}
    seal = hdf5_seal(image, places)
    first, *lines = seal.rstrip(b"\0").split(b"\n")
    assert len(seal) == 512
    assert first == b"hakobune: CRC-32 %08x of what follows, HDF5 from byte 512" % zlib.crc32(
        seal[len(first) + 1 :] + image
    )
    assert lines[0] == b"%08x 8 100 a" % zlib.crc32(image[8:108])
    assert lines[1] == b"%08x 300 50 group/b" % zlib.crc32(image[300:350])
    many = {f"dataset {i}": (8, 1) for i in range(40)}
    assert len(hdf5_seal(image, many)) == 2048 and len(hdf5_seal(image, places, size=4096)) == 4096
    table = sum(len(f"{0:08x} 8 1 {name}\n") for name in many)
    assert 1024 < table + 100 <= 2048


def test_the_block_doubles_where_its_table_and_a_hundred_bytes_do_not_fit():
    image = SIGNATURE + bytes(100)
    for length, size in ((512 - 100 - 14, 512), (512 - 100 - 13, 1024)):
        name = "n" * length
        assert len(f"{0:08x} 8 1 {name}\n") - length == 14
        assert len(hdf5_seal(image, {name: (8, 1)})) == size


def test_places_that_are_filled_in_do_not_count_and_what_is_between_them_does(tmp_path):
    """Filled in: 100 to 150, 140 to 200 and 300 to 310, as one and one; an empty place is none"""
    image = bytearray(SIGNATURE + bytes(range(256)) * 4)
    filled = [(300, 10), (140, 60), (100, 50), (50, 0)]
    seal = hdf5_seal(bytes(image), {"a": (8, 20)}, filled, "a kind of file")
    assert b"a kind of file\n" in seal and b"filled in 100 100\nfilled in 300 10\n" in seal
    path = tmp_path / "a.h5"
    for place, counts in ((99, True), (100, False), (145, False), (199, False), (200, True), (299, True), (305, False),
                          (310, True), (50, True), (len(image) - 1, True)):  # fmt: skip
        other = bytearray(image)
        other[place] ^= 1
        path.write_bytes(seal + other)
        assert bool(damage(path)) == counts, place
    path.write_bytes(seal + image)
    assert kind_filled_in(path) == "a kind of file" and is_sealed(path) and not damage(path)
    path.write_bytes(hdf5_seal(bytes(image), {}) + image)
    assert kind_filled_in(path) == "" and kind_filled_in(tmp_path / "none") == ""


def test_damage_names_the_first_of_several_and_how_many(tmp_path):
    image, path = bytearray(SIGNATURE + bytes(1000)), tmp_path / "a.h5"
    seal = hdf5_seal(bytes(image), {"a": (100, 50), "b": (200, 50), "c": (300, 50)})
    cases = ([120], "a"), ([220], "b"), ([220, 320], "b and 1 others"), ([120, 220, 320], "a and 2 others")
    for places, words in (*cases, ([20], "its structure, names or attributes")):
        other = bytearray(image)
        for place in places:
            other[place] ^= 1
        path.write_bytes(seal + other)
        assert damage(path) == words
    path.write_bytes(seal + image[:320])
    assert damage(path) == "its end, which is truncated"


def test_a_seal_is_looked_for_where_hdf5_looks_for_itself(tmp_path):
    """At 512, 1024 … 2²⁰; one whose first line is gone is missed there, and a file without a block has none"""
    path = tmp_path / "a.h5"
    for size in (512, 2**15, 2**20):
        path.write_bytes(bytes(size) + SIGNATURE + bytes(100))
        assert is_sealed(path) and damage(path) == "its seal"
    for content in (SIGNATURE + bytes(1000), bytes(513) + SIGNATURE, bytes(2**21) + SIGNATURE, b"", b"hakobune"):
        path.write_bytes(content)
        assert not is_sealed(path) and damage(path) == ""
    path.write_bytes(b"hakobune: ")
    assert is_sealed(path)


def test_much_behind_the_last_number_is_its_end(tmp_path):
    """More than 2²⁴ bytes beside as many as up to the last number"""
    image, path = SIGNATURE + bytes(1000), tmp_path / "a.h5"
    seal = hdf5_seal(image, {"a": (8, 992)})
    for more, words in (
        (2**24 - 100, "its structure, names or attributes"),
        (2**24 + 3000, "its end: the file has 1.68e+07"),
    ):
        with path.open("wb") as file:
            file.write(seal + image)
            file.truncate(len(seal + image) + more)
        assert damage(path).startswith(words)


def test_a_text_without_a_head_gets_one(tmp_path):
    path = tmp_path / "a.csv"
    write_sealed(path, "x,y\n1,2\n")
    first, rest = path.read_text().split("\n", 1)
    assert first == f"#  [CRC-32 of all else: {zlib.crc32(b'#' + chr(10).encode() + rest.encode()):08x}]"
    assert rest == "x,y\n1,2\n" and text_sealed(path.read_text()) and not text_sealed(rest)
    write_sealed(path, TEXT)
    lines = path.read_text().split("\n")
    assert lines[0] == "# a table" and lines[1] == f"# of two columns{MARK}{zlib.crc32(TEXT.encode()):08x}]"
