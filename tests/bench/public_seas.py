"""Spectra and records of others, found under a folder: is each read, and has it the height that the file gives.

    python tests/bench/public_seas.py FOLDER

A file of several times is read at its first.  Right is a spectrum of a positive height; readers hold it against the
file's own height where it has one.  What a package of others makes of the same files: `wavespectra`, by another Python.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.environment.wave_records import read_record
from hakobune.mooring.seas.spectra_files import read_sea

SPECTRA = (
    *(".spc", ".spec", ".sp1", ".sp2", ".s1d", ".s2d", ".swn", ".hot"),
    *(".his", ".spt", ".dirspec", ".nondirspec", ".data_spec", ".swden", ".nc", ".nc4"),
)
HEADS = ("SWAN ", "'WAVEWATCH III SPECTRA'", "TRIAXYS", "#YY  MM DD hh", "#YY MM DD hh", "YYYY MM DD hh", "YY MM DD hh")
NUMBERS = re.compile(r"\s\d?\.\d|Sep_Freq", re.IGNORECASE)
TIME = re.compile(r"\d{8}[. ]\d{6}|\d{4}-\d\d-\d\dT\d\d:\d\d|(?<=first is )\S+")
PARTS = re.compile(r"(\w{5})[dijk](\d{4}\.\w+)")


def of_seas(folder):
    """Files that hold spectra by their ending or their first line; of netCDF and NDBC those with frequencies"""
    for path in sorted(folder.rglob("*")):
        head, ending = _head(path) if path.is_file() else "", path.suffix.lower()
        if not path.is_file() or (head.startswith(("#YY", "YY")) and not NUMBERS.search(head)):
            continue
        if ending in (".nc", ".nc4") and not _spectral(path.read_bytes().lower()):
            continue
        if PARTS.fullmatch(path.name) and path.with_name(PARTS.sub(r"\1w\2", path.name)).is_file():
            continue  # directions of NDBC, read with the densities beside them
        if ending in SPECTRA or head.startswith(HEADS):
            yield path


def judged(path):
    """("right", "refused" or "wrong", why) of a file of a spectrum"""
    try:
        sea = read_sea(path, 0.0)
    except TableError as error:
        time = _first_time(path, str(error))
        if time is None:
            return "refused", str(error).replace(str(path), path.name)
        try:
            sea = read_sea(path, 0.0, time)
        except TableError as again:
            return "refused", str(again).replace(str(path), path.name)
    height = float(sea.spectrum.significant_height)
    return ("right" if height > 0 else "wrong"), f"{height:.4g} m, {sea.spreading or 'long-crested'}"


def judged_record(path):
    """The same of a record of elevations"""
    try:
        record = read_record(path)
    except TableError as error:
        return "refused", str(error).replace(str(path), path.name)
    return "right", f"{len(record.elevation)} values each {record.step:g} s, σ {record.elevation.std():.4g} m"


def _first_time(path, said):
    if "rows" in said and (rows := re.findall(r"^\s*(\d{2,4}(?: +\d\d){3,4})\s", _text(path), re.MULTILINE)):
        return " ".join(rows[0].split())
    found = TIME.search(said) if re.search("choose one with (the key )?time", said) else None
    return found[0].rstrip(";,") if found else None


def _spectral(content):
    """Whether the names in a netCDF file are those of a spectrum; not added mass, nor velocities of a current meter"""
    named = any(word in content for word in (b"efth", b"d2fd", b"spec", b"variance_density", b"vadens", b"energy"))
    return b"freq" in content and named and b"added_mass" not in content and b"beam2inst" not in content


def _text(path):
    from hakobune.meshing.text_files import read_text

    return read_text(path, TableError)


def _head(path):
    try:
        return path.open(errors="replace").readline(120).lstrip()
    except OSError:
        return ""


def main(folder):
    count = Counter()
    for path in of_seas(folder):
        verdict, why = judged(path)
        count[verdict] += 1
        print(f"{verdict:8} {path.relative_to(folder)}: {why[:200]}")
    print(dict(count))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
