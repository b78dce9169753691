"""Seals of result files: a CRC-32 of the contents, which shows whether the file is as it was written.

HDF5   a block before the file, which HDF5 leaves to its user: a line with the CRC-32 of every byte after it,
       then a line for each dataset, with which damage is named.  Where numbers are filled in later, their places
       are listed and do not count: they have checksums of their own, and what HDF5 goes by while it reads is whole
text   the last of the # lines at its head, with the CRC-32 of all other lines
"""

from __future__ import annotations

import os
import re
import zlib
from pathlib import Path

from .whole_files import write_whole

START = b"hakobune: "
FILLED = b" but what is filled in"
FIRST = re.compile(START + rb"CRC-32 ([0-9a-f]{8}) of what follows(" + FILLED + rb")?, HDF5 from byte (\d{1,18})\n")
PLACE = re.compile(r"filled in (\d{1,18}) (\d{1,18})")  # first byte from that of HDF5, bytes
DATASET = re.compile(r"([0-9a-f]{8}) (\d{1,18}) (\d{1,18}) (.+)")  # CRC-32, first byte from that of HDF5, bytes, name
SIGNATURE = b"\x89HDF\r\n\x1a\n"
LEAST_BLOCK, LARGEST_BLOCK = 512, 2**20  # bytes; HDF5 looks for itself at 0, 512, 1024, …, powers of two
LONGEST_HEAD = 2**16  # characters of a text in which its mark is looked for
AT_ONCE = 2**22  # bytes read of a file
MOST_BEHIND = 2**24  # bytes of names and attributes behind the last numbers, beside as many as these
MARK = "  [CRC-32 of all else: "
# either end of a mark that is damaged elsewhere; words of it alone, as "of all lines", stand in many a text
TRACE = re.compile(r"\[CRC-32|else: [0-9a-f]{8}\]")
REMEDY = "copy it again, or delete it and make it again"


def hdf5_seal(image, places, filled=(), kind="", size=LEAST_BLOCK):
    """The block before an HDF5 file.

    image : its bytes; places : {name: (first byte, bytes)} of its datasets that are whole
    filled : (first byte, bytes) of those that are filled in later; kind : of such a file, in words
    size : bytes of the block, if they are enough
    """
    filled = _joined(filled)
    lines = [f"{zlib.crc32(image[a : a + n]):08x} {a} {n} {name}\n" for name, (a, n) in places.items()]
    said = [f"{kind}\n"] if filled else []
    table = "".join([*said, *lines, *(f"filled in {a} {n}\n" for a, n in filled)]).encode()
    while size < len(table) + 100:
        size *= 2
    end = b"%s, HDF5 from byte %d\n" % (FILLED if filled else b"", size)
    rest = table.ljust(size - len(START + b"CRC-32 00000000 of what follows" + end), b"\0")
    value = zlib.crc32(rest)
    for begin, stop in _kept(filled, len(image)):
        value = zlib.crc32(image[begin:stop], value)
    return START + b"CRC-32 %08x of what follows" % value + end + rest


def _joined(places):
    """Places (first byte, bytes), ascending, those that touch as one"""
    out = []
    for begin, count in sorted(places):
        if out and sum(out[-1]) >= begin:
            out[-1] = out[-1][0], max(sum(out[-1]), begin + count) - out[-1][0]
        elif count:
            out.append((begin, count))
    return out


def _kept(filled, size):
    """(first byte, end) between places, ascending, of `size` bytes"""
    begin = 0
    for place, count in filled:
        yield begin, place
        begin = place + count
    yield begin, max(begin, size)


def is_sealed(path):
    """Whether an HDF5 file, or a text, has a seal, broken or not; False where there is no file"""
    try:
        return _sealed_hdf5(path) if Path(path).is_file() else False
    except OSError:
        return False


def kind_filled_in(path):
    """What a file is that has a seal which leaves room for numbers to be filled in, broken or not; "" for any other"""
    try:
        with Path(path).open("rb") as file:
            first = FIRST.fullmatch(file.readline(100))
            return file.readline(100).decode(errors="replace").strip() if first and first[2] else ""
    except OSError:
        return ""


def damage(path):
    """What is damaged of a sealed HDF5 file, in some words; "" where nothing is, or it has no seal.  Raises OSError."""
    if not _sealed_hdf5(path):
        return ""
    with Path(path).open("rb") as file:
        first = FIRST.fullmatch(file.readline(100))
        if first is None:
            return "its seal"
        value, begin = int(first[1], 16), int(first[3])
        rest = file.read(max(0, min(begin - file.tell(), LARGEST_BLOCK)))
        lines = rest.decode(errors="replace").splitlines()
        filled = [(int(part[1]), int(part[2])) for part in map(PLACE.fullmatch, lines) if part]
        found = [DATASET.fullmatch(line) for line in lines]
        places = [*filled, *((int(part[2]), int(part[3])) for part in found if part)]
        last, size = begin + max(map(sum, places), default=0), file.seek(0, os.SEEK_END)
        if size > 2 * last + MOST_BEHIND:  # a terabyte of zeros would be read for an hour
            return f"its end: it has {size:.3g} bytes, its numbers end at {last:.3g}"
        if _crc_without(file, begin, filled, zlib.crc32(rest)) == value:
            return ""
        if last > size:
            return "its end, which is truncated"
        wrong = [part[4] for part in found if part and _piece_differs(file, begin, part)]
    more = f" and {len(wrong) - 1} others" if len(wrong) > 1 else ""
    return f"{wrong[0]}{more}" if wrong else "its structure, names or attributes"


def _sealed_hdf5(path):
    """Whether a file is HDF5 behind a block, which only sealed ones of ours have, or begins as a seal does"""
    with Path(path).open("rb") as file:
        opening = file.read(len(SIGNATURE) + len(START))
        if opening.startswith(SIGNATURE) or not opening:
            return False
        if opening.startswith(START):
            return True
        place = LEAST_BLOCK
        while place <= LARGEST_BLOCK:
            file.seek(place)
            if file.read(len(SIGNATURE)) == SIGNATURE:
                return True
            place *= 2
    return False


def _piece_differs(file, begin, line):
    file.seek(begin + int(line[2]))
    return _crc(file, int(line[3])) != int(line[1], 16)


def _crc_without(file, begin, filled, value):
    """CRC-32, from `value` on, of an open file from the byte `begin` on, without the places that are filled in"""
    size = file.seek(0, os.SEEK_END)
    for first, end in _kept(filled, size - begin):
        file.seek(begin + first)
        value = _crc(file, max(0, end - first), value)
    return value


def _crc(file, count, value=0):
    """CRC-32, from `value` on, of the next `count` bytes of an open file, or of those that there are"""
    while count > 0:
        part = file.read(min(count, AT_ONCE))
        if not part:
            break
        value = zlib.crc32(part, value)
        count -= len(part)
    return value


def write_sealed(path, text):
    """Write a text whose first lines begin with #, sealed.  Raises `meshing.whole_files.NotWritten`."""
    head = _end_of_head(text)
    text, head = (text, head) if head else (f"#\n{text}", 2)
    write_whole(path, text[: head - 1], f"{MARK}{zlib.crc32(text.encode()):08x}]", text[head - 1 :])


def text_sealed(text):
    """Whether a text has a seal, broken or not"""
    return MARK in text[: _end_of_head(text)]


def text_damaged(text):
    """Whether a text, its lines ended by line feeds, has a seal that is broken"""
    head = _end_of_head(text)
    place = text.find(MARK, 0, head)
    if place < 0:  # a new line within the head ends it there
        return TRACE.search(text, 0, LONGEST_HEAD) is not None
    end = place + len(MARK) + 9
    value = zlib.crc32(text[end:].encode(), zlib.crc32(text[:place].encode()))
    return text[place:end] != f"{MARK}{value:08x}]"


def _end_of_head(text):
    """Where the lines at the beginning that begin with # end, after the last line feed"""
    end = 0
    while text.startswith("#", end):
        end = text.find("\n", end) + 1 or len(text)
    return end
