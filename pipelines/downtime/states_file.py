"""The file of simulated states: one line for each finished state. A kill at any time keeps all complete lines.

The first line describes the states; each further line is JSON with its CRC-32.  A line cut by a kill is removed; a
damaged line is an error.
"""

import json
import os
import zlib
from pathlib import Path

from ..common.quantities import StudyError

MARK = "# hakobune downtime states "


def read(path, identity):
    """{index of the hour: results of its seeds} in a file, without an incomplete last line; {} without a file.

    Raises StudyError for a file of other states, or for a damaged file.
    """
    path = Path(path)
    if not path.exists():
        path.write_text(f"{MARK}{identity}\n", encoding="utf-8")
        return {}
    content = path.read_bytes()
    whole = content[: content.rfind(b"\n") + 1]
    first, *lines = whole.decode("utf-8", "replace").splitlines() or [""]
    if not content.startswith(MARK.encode()[: len(content)]):
        raise StudyError(
            f"{path} is not a file of simulated states, so it is not replaced; give another name (--states)"
        )
    if first and first != f"{MARK}{identity}":
        raise StudyError(
            f"{path} belongs to another hindcast, mooring study, database, seeds or duration; give another name "
            "(--states), or delete it"
        )
    if len(whole) < len(content) or not first:
        with path.open("r+b") as file:
            file.truncate(len(whole))
        if not first:
            path.write_text(f"{MARK}{identity}\n", encoding="utf-8")
    found = {}
    for number, line in enumerate(lines, 2):
        text, _, mark = line.rpartition(" ")
        if not mark.isdigit() or zlib.crc32(text.encode()) != int(mark):
            raise StudyError(f"{path}, line {number}, is damaged: it does not match its checksum; delete the line")
        row = json.loads(text)
        found[row["hour"]] = row
    return found


def append(path, row):
    """Add a row {"hour": number, …} to the file, and make sure that it is on the disk"""
    text = json.dumps(row, sort_keys=True)
    with Path(path).open("ab") as file:
        file.write(f"{text} {zlib.crc32(text.encode())}\n".encode())
        file.flush()
        os.fsync(file.fileno())
