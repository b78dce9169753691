"""Seals of result files: a CRC-32 of the contents, which shows later changes of the file.

HDF5   The seal is a block before the file, which HDF5 reserves for users: a line with the CRC-32 of every byte after
      it, then a line for each dataset, which locates damage.  Numbers that are filled in later are listed by place
      and excluded, because they have their own checksums. The structures that HDF5 reads are included.
text   The seal is the last of the # lines of the header, with the CRC-32 of all other lines.
"""

import os
import re
import zlib
from pathlib import Path

from .whole_files import write_whole

START = b"hakobune: "
FILLED = b" but what is filled in"
FIRST = re.compile(START + rb"CRC-32 ([0-9a-f]{8}) of what follows(" + FILLED + rb")?, HDF5 from byte (\d{1,18})\n")
PLACE = re.compile(r"filled in (\d{1,18}) (\d{1,18})")  # first byte counted from the start of HDF5, number of bytes
DATASET = re.compile(r"([0-9a-f]{8}) (\d{1,18}) (\d{1,18}) (.+)")  # CRC-32, first byte from that of HDF5, bytes, name
SIGNATURE = b"\x89HDF\r\n\x1a\n"
LEAST_BLOCK, LARGEST_BLOCK = 512, 2**20  # bytes; HDF5 looks for its start at 0, 512, 1024, …, powers of two
LONGEST_HEAD = 2**16  # characters of a text that are searched for the seal
AT_ONCE = 2**22  # bytes read of a file
MOST_BEHIND = 2**24  # bytes of names and attributes allowed after the last numbers, beyond an equal amount
MARK = "  [CRC-32 of all else: "
# both ends of a seal, so that a seal damaged elsewhere is found; its words alone, such as "of all lines", occur in many
# texts
TRACE = re.compile(r"\[CRC-32|else: [0-9a-f]{8}\]")
REMEDY = "copy it again, or delete it and make it again"


def hdf5_seal(image, places, filled=(), kind="", size=LEAST_BLOCK):
    """The seal of an HDF5 file, a block that stands before the file.

    image : bytes of the file; places : {name: (first byte, number of bytes)} of complete datasets
    filled : [(first byte, number of bytes)] of datasets that are filled in later; kind : kind of the file, in words
    size : number of bytes of the block, if the seal needs no more
    """
    filled = _joined(filled)
    lines = [f"{zlib.crc32(image[a : a + n]):08x} {a} {n} {name}\n" for name, (a, n) in places.items()]
    said = [f"{kind}\n"] if filled else []
    table = "".join([*said, *lines, *[f"filled in {a} {n}\n" for a, n in filled]]).encode()
    while size < len(table) + 100:
        size *= 2
    end = b"%s, HDF5 from byte %d\n" % (FILLED if filled else b"", size)
    rest = table.ljust(size - len(START + b"CRC-32 00000000 of what follows" + end), b"\0")
    value = zlib.crc32(rest)
    for begin, stop in _kept(filled, len(image)):
        value = zlib.crc32(image[begin:stop], value)
    return START + b"CRC-32 %08x of what follows" % value + end + rest


def _joined(places):
    """Places (first byte, bytes) in ascending order; adjacent places are joined"""
    out = []
    for begin, count in sorted(places):
        if out and sum(out[-1]) >= begin:
            out[-1] = out[-1][0], max(sum(out[-1]), begin + count) - out[-1][0]
        elif count:
            out.append((begin, count))
    return out


def _kept(filled, size):
    """Ranges (first byte, end) between ascending places in a file of `size` bytes"""
    begins = [0, *map(sum, filled)]
    return list(zip(begins, [place for place, _ in filled] + [max(begins[-1], size)], strict=True))


def is_sealed(path):
    """Whether an HDF5 or text file has a seal, intact or broken; False where no file exists"""
    try:
        return _sealed_hdf5(path) if Path(path).is_file() else False
    except OSError:
        return False


def kind_filled_in(path):
    """Kind of a sealed file whose numbers are filled in later, with an intact or a broken seal; "" for any other
    file"""
    try:
        with Path(path).open("rb") as file:
            first = FIRST.fullmatch(file.readline(100))
            return file.readline(100).decode(errors="replace").strip() if first and first[2] else ""
    except OSError:
        return ""


def damage(path):
    """Damage of a sealed HDF5 file, in words; "" for an intact file or one without a seal.  Raises OSError."""
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
        places = filled + [(int(part[2]), int(part[3])) for part in found if part]
        last, size = begin + max(map(sum, places), default=0), file.seek(0, os.SEEK_END)
        if size > 2 * last + MOST_BEHIND:  # reading a terabyte of zeros would take an hour
            return f"its end: the file has {size:.3g} bytes, but its numbers end at byte {last:.3g}"
        if _crc_without(file, begin, filled, zlib.crc32(rest)) == value:
            return ""
        if last > size:
            return "its end, which is truncated"
        wrong = [part[4] for part in found if part and _piece_differs(file, begin, part)]
    more = f" and {len(wrong) - 1} others" if len(wrong) > 1 else ""
    return f"{wrong[0]}{more}" if wrong else "its structure, names or attributes"


def _sealed_hdf5(path):
    """Whether a file is HDF5 behind a block, as only this program's sealed files are, or begins as a seal does"""
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
    """CRC-32, starting from `value`, of an open file from the byte `begin` on, without the places `filled` in later"""
    size = file.seek(0, os.SEEK_END)
    for first, end in _kept(filled, size - begin):
        file.seek(begin + first)
        value = _crc(file, max(0, end - first), value)
    return value


def _crc(file, count, value=0):
    """CRC-32, starting from `value`, of the next `count` bytes of an open file, or of those up to its end"""
    while count > 0:
        part = file.read(min(count, AT_ONCE))
        if not part:
            break
        value = zlib.crc32(part, value)
        count -= len(part)
    return value


def write_sealed(path, text):
    """Write a text whose first lines begin with #, with a seal.  Raises `meshing.whole_files.NotWritten`."""
    head = _end_of_head(text)
    text, head = (text, head) if head else (f"#\n{text}", 2)
    write_whole(path, text[: head - 1], f"{MARK}{zlib.crc32(text.encode()):08x}]", text[head - 1 :])


def text_sealed(text):
    """Whether a text has a seal, intact or broken"""
    return MARK in text[: _end_of_head(text)]


def text_damaged(text):
    """Whether a text, with line feeds as line ends, has a broken seal"""
    head = _end_of_head(text)
    place = text.find(MARK, 0, head)
    if place < 0:  # a line feed inside the header ends the header there
        return TRACE.search(text, 0, LONGEST_HEAD) is not None
    end = place + len(MARK) + 9
    value = zlib.crc32(text[end:].encode(), zlib.crc32(text[:place].encode()))
    return text[place:end] != f"{MARK}{value:08x}]"


def _end_of_head(text):
    """Index after the last line feed of the leading lines that begin with #"""
    end = 0
    while text.startswith("#", end):
        end = text.find("\n", end) + 1 or len(text)
    return end
