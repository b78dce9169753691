"""Text files of other programs: UTF-8 with or without a byte order mark; only regular files of limited size are
read."""

import csv
import gzip
import stat
import zlib
from pathlib import Path

from .seals import MARK, REMEDY, text_damaged

LARGEST = 256  # MB; a record of ten million values


def read_text(path, error=ValueError, *, errors="strict", largest=LARGEST):
    """The text of a regular file, without a byte order mark.

    error : class of the exception to raise; errors : as in `bytes.decode`; largest : largest size, MB
    raises : `error` for a file that is missing, not text, not permitted, endless (device, pipe) or too large, or
        whose seal is broken (`seals`)
    """
    path = Path(path)
    try:
        check_size(path, error, largest)
        text = _content(path, error, largest).decode("utf-8-sig", errors).replace("\r\n", "\n")
    except FileNotFoundError:
        raise error(f"{path} does not exist") from None
    except UnicodeDecodeError:
        raise error(f"{path} cannot be read: not text in UTF-8") from None
    except (OSError, EOFError, zlib.error) as fault:
        raise error(f"{path} cannot be read: {getattr(fault, 'strerror', None) or fault}") from None
    if text_damaged(text):
        raise error(
            f"{path} is damaged: its lines do not match their checksum; {REMEDY}; if it was changed on purpose, "
            f"delete {MARK.strip()!r} and the rest of that line"
        )
    return text


def _content(path, error, largest):
    """Bytes of a file, unpacked for `.gz`; raises `error` above `largest` MB"""
    if path.suffix != ".gz":
        return path.read_bytes()
    with gzip.open(path) as packed:
        content = packed.read(int(largest * 1e6) + 1)
    if len(content) > largest * 1e6:
        raise error(f"{path} has more than {largest} MB unpacked; allowed: up to that")
    return content


def check_size(path, error=ValueError, largest=LARGEST):
    """Raise `error` if a path is no regular file or exceeds `largest` MB, and OSError if the file is not accessible."""
    found = Path(path).stat()
    if stat.S_ISDIR(found.st_mode):
        raise error(f"{path} cannot be read: Is a directory")
    if not stat.S_ISREG(found.st_mode):
        raise error(f"{path} cannot be read: it is a device or a pipe, which may have no end; give a file")
    if found.st_size > largest * 1e6:
        raise error(f"{path} has {found.st_size / 1e6:.0f} MB; allowed: up to {largest} MB")


def is_number(word):
    """Whether Python's float accepts a word"""
    try:
        float(word)
    except ValueError:
        return False
    return True


def numbers_of(line):
    """The numbers at the beginning of a line, as Fortran reads them: 1.D0 and 1, 2 are accepted; a word ends the
    numbers"""
    found = []
    for word in line.replace(",", " ").split():
        try:
            found.append(float(word.upper().replace("D", "E")))
        except ValueError:
            break
    return found


def csv_rows(text):
    """Rows of a CSV text with column names, as a `csv.DictReader`; empty lines and # lines are skipped"""
    return csv.DictReader(line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#"))


def packaged_rows(package, name):
    """Rows of `tables/NAME.csv` in a folder of the program, each a dictionary of texts; the # lines of the file name
    the source"""
    from importlib.resources import files

    return list(csv_rows(files(package).joinpath("tables", f"{name}.csv").read_text(encoding="utf-8")))
