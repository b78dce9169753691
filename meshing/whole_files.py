"""Files are written completely or not at all: a file is written under another name, then read back, then renamed.

If the disk is full or a quota is reached, the old file remains and a one-line error gives the reason.
"""

import contextlib
import errno
import os
from pathlib import Path


class NotWritten(OSError):
    """A file could not be written; the earlier file of that name is unchanged."""


def write_whole(path, *content):
    """Write texts or bytes, one after another, to a file and replace its content.

    raises : NotWritten, with one line of text, if the disk does not accept the content
    """
    parts = [part.encode() if isinstance(part, str) else part for part in content]
    with made_beside(path) as partial:
        with partial.open("wb") as file:
            for part in parts:
                file.write(part)
        if partial.stat().st_size != sum(map(len, parts)):
            raise OSError(0, "a part of the file was not written")


@contextlib.contextmanager
def made_beside(path):
    """Context with the path of a new file of the same suffix, renamed to `path` when it is complete"""
    path = Path(path)
    partial = path.with_name(f"{path.stem}.partial{path.suffix}")
    try:
        yield partial
        with partial.open("rb+") as file:
            os.fsync(file.fileno())
        os.replace(partial, path)
    except NotWritten:
        raise
    except OSError as error:
        raise not_written(path, error) from None
    finally:
        with contextlib.suppress(OSError):
            partial.unlink()


def keep_room(path):
    """Allocate every byte of a file that is written in place, including holes of a sparse copy.  Raises NotWritten.

    A file that is missing or not regular is not touched here; the code that opens it reports the error.
    """
    try:
        if not Path(path).is_file():
            return
        with Path(path).open("rb+", buffering=0) as file:
            size = file.seek(0, os.SEEK_END)
            if hasattr(os, "posix_fallocate") and size:
                os.posix_fallocate(file.fileno(), 0, size)
            file.seek(max(0, size - 1))
            last = file.read(1)
            file.seek(max(0, size - 1))
            file.write(last)  # raises the error of a file-size limit
    except PermissionError:
        return
    except OSError as error:
        if error.errno in (errno.EOPNOTSUPP, errno.EINVAL):
            return
        raise not_written(path, error) from None


def not_written(path, error):
    """The NotWritten to raise for a file that an OSError kept from being written"""
    reason = error.strerror or " ".join(str(error).split())
    return NotWritten(f"{path} cannot be written: {reason}; the file that was there before is unchanged")
