"""Text spectra of buoys and their operators.

    NDBC       densities of a year (swden, station w year .txt): a head "#YY MM DD hh mm .0200 .0325 …", rows of m²/Hz;
               files of the same name with d, i, j, k for w have α₁, α₂ (degrees from), r₁ and r₂ (hundredths)
               of the last days (.data_spec): rows "YY MM DD hh mm Sep_Freq spec_1 (freq_1) …"; .swdir, .swdir2, .swr1,
               .swr2 beside it likewise; 999 for none
    Datawell   .spt: twelve lines, the second Hm0 in cm, the fourth the largest density in m²/Hz; rows of Hz, share of
               the largest density, direction from, spread, skewness, kurtosis
    Triaxys    NONDIRSPEC: Hz, m²/Hz; DIRSPEC: rows of frequencies, columns of directions from, m²/Hz/degree
               .his: a history of heights, periods and directions, which is no spectrum: an error reports it
    TRDI       WavesMon's DSpec….txt: rows of frequencies, columns of slices of directions from, mm²/Hz/degree; PSpec…,
               SSpec… and VSpec….txt: a root of density in a row, mm/√Hz
    Spotter    .csv: columns f_i, varianceDensity_i, direction_i (from), directionalSpread_i and Significant Wave Height

If a file states a height, its spectrum is checked against it.
"""

import csv
import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import read_text

from ..environment.sea import Sea
from ..environment.spectra import tabulated
from ..environment.tables import TableError
from . import directions
from .planes import two_dimensional

MISSING = 999.0
OFF = 0.1  # largest relative difference between a file's stated height and that of its spectrum
DAYS = (".swdir", ".swdir2", ".swr1", ".swr2")


def kind(text):
    """The reader for the format of a text, None for other formats"""
    head = text.lstrip()[:2000]
    lines = head.splitlines() or [""]
    if re.match(r"#?\s*Y", head) and re.match(r"#?\s*YY(YY)?\s+MM\s+DD", lines[0]):
        return ndbc
    if "TRIAXYS" in lines[0]:
        return triaxys
    if "varianceDensity_0" in text[:20000] and "f_0" in text[:20000]:
        return spotter
    if "Frequency Bands are" in head:
        return trdi
    if re.match(r"\d{4}-\d\d-\d\dT[\d:.]+Z?[,\t ]", head) and len(re.findall(r"[-+.\dEe]+", lines[0][20:])) > 14:
        return history
    if len(lines) > 14 and all(re.fullmatch(r"\s*[-+.\dEe]+\s*", line) for line in lines[:12]) and "," in lines[12]:
        return datawell
    return None


def ndbc(path, text, x_axis, time):
    """Sea of the row of `time`; with directions if the direction files exist and x_axis, compass degrees, is given"""
    frequency, density = _row(path, text, time)
    density = _measured(path, frequency, density, time)
    beside = None if x_axis is None else _directions_beside(path)
    if beside is None:
        return _plain(path, frequency, density)
    rows = [_row(place, read_text(place, TableError), time or _times(text)[0], False) for place in beside]
    if any(len(row[0]) != len(frequency) or np.abs(row[0] - frequency).max() > 1e-4 for row in rows):
        raise TableError(
            f"{path}: {beside[0].name} has different frequencies; allowed: the same frequencies in all its files"
        )
    values = [np.where(row[1] >= MISSING, np.nan, row[1]) for row in rows]
    scale = 0.01 if path.suffix == ".txt" or path.name.endswith(".txt.gz") else 1.0
    spread = directions.of_moments(scale * values[2], scale * values[3], *np.radians(values[:2]))
    return _spread(path, frequency, density, spread, x_axis)


def datawell(path, text, x_axis, time):
    """Sea of a Datawell .spt"""
    lines = [line for line in text.splitlines() if line.strip()]
    try:
        height, most = float(lines[1]) / 100, float(lines[3])
        rows = np.array([[float(word) for word in line.split(",")[:4]] for line in lines[12:]]).reshape(-1, 4)
    except (ValueError, IndexError):
        raise TableError(f"{path}: a Datawell .spt file has 12 numbers, then rows of 6; this file does not") from None
    frequency, share, alpha, spread = rows.T
    spread = directions.of_spread(np.radians(alpha), np.radians(spread))
    return _held(path, _spread(path, frequency, most * share, spread, x_axis), height)


def history(path, text, x_axis, time):
    """Raise TableError, since a .his file has no densities; the message quotes the first row, or the row of `time`"""
    rows = [re.split(r"[,\t ]+", line.strip()) for line in text.splitlines() if line.strip()]
    rows = [row for row in rows if time is None or row[0].startswith(str(time).strip().replace(" ", "T"))]
    if not rows:
        raise TableError(f"{path} is a history of Datawell and has no time {time}")
    at, peak, direction, _, _, height = rows[0][:6]
    raise TableError(
        f"{path} is a Datawell history, not a spectrum; at {at} it gives a height of {float(height) / 100:.4g} "
        f"m and a peak period of {peak} s from {direction}°; give these as height, peak period and direction, or "
        "give the .spt file"
    )


def trdi(path, text, x_axis, time):
    """Sea of a TRDI DSpec, PSpec, SSpec or VSpec file"""
    number = r"\s+([\d.]+)"
    lines = text.splitlines()
    head = "\n".join(line for line in lines if line.lstrip().startswith("%"))
    found = re.search(rf"Bands are{number} Hz wide\s*\(first frequency band is centered at{number}", head)
    start = re.search(rf"first direction slice begins at{number}", head)
    try:
        step, first = map(float, found.groups())
        rows = [[float(word) for word in line.split()] for line in lines if line.strip() and "%" not in line]
        values = np.array(rows if start else [[x] for row in rows for x in row], float)
    except (AttributeError, ValueError):
        raise TableError(
            f"{path}: a WavesMon file states its frequency bands, then gives numbers; this file does not"
        ) from None
    frequency = first + step * np.arange(len(values))
    if start is None:
        return _plain(path, frequency, (values[:, 0] / 1e3) ** 2)
    if x_axis is None:
        raise _no_axis(path)
    alpha = np.radians(float(start[1])) + (np.arange(values.shape[1]) + 0.5) * (2 * np.pi / values.shape[1])
    return _plane(path, frequency, np.radians(x_axis) - alpha - np.pi, np.degrees(values / 1e6))


def triaxys(path, text, x_axis, time):
    """Sea of a Triaxys NONDIRSPEC or DIRSPEC file"""
    head = dict(re.findall(r"^([A-Z][A-Z ()/a-z]*?)\s*=\s*(.*)$", text, re.MULTILINE))
    try:
        first, step = (float(head[key]) for key in ("INITIAL FREQUENCY (Hz)", "FREQUENCY SPACING (Hz)"))
        rows = [[float(word) for word in line.split()] for line in text.splitlines() if re.match(r"\s*[-.\d]", line)]
        values = np.array(rows, float)
    except (KeyError, ValueError):
        raise TableError(
            f"{path}: a Triaxys file states frequencies in its header, then gives rows; this file does not"
        ) from None
    if "DIRECTION SPACING (DEG)" not in head:
        return _plain(path, values[:, 0], values[:, 1])
    if x_axis is None:
        raise _no_axis(path)
    frequency = first + step * np.arange(len(values))
    alpha = np.radians(float(head["DIRECTION SPACING (DEG)"]) * np.arange(values.shape[1]))
    turn = alpha < 2 * np.pi - 1e-9  # 0 and 360 are the same
    kept = frequency > 0
    return _plane(path, frequency[kept], np.radians(x_axis) - alpha[turn] - np.pi, np.degrees(values[kept][:, turn]))


def spotter(path, text, x_axis, time):
    """Sea of a row of a Spotter .csv"""
    rows = list(csv.reader(text.splitlines(), skipinitialspace=True))
    names = [name.strip() for name in rows[0]]
    rows = [dict(zip(names, row, strict=False)) for row in rows[1:] if len(row) > 1]
    times = [datetime.fromtimestamp(float(row["Epoch Time"]), UTC).strftime("%Y-%m-%dT%H:%M") for row in rows]
    row = rows[one_of(path, times, time)]
    try:
        frequency, density, alpha, spread = (
            np.array([float(row[f"{name}_{i}"]) for i in range(sum(key.startswith("f_") for key in names))])
            for name in ("f", "varianceDensity", "direction", "directionalSpread")
        )
        height = float(row["Significant Wave Height (m)"])
    except (KeyError, ValueError) as fault:
        raise TableError(f"{path}: its row of {row['Epoch Time']} has no spectrum ({fault})") from None
    spread = directions.of_spread(np.radians(alpha), np.radians(spread))
    return _held(path, _spread(path, frequency, density, spread, x_axis), height)


def one_of(path, times, time):
    """Index of the time that begins with `time` in a list of texts; if `time` is None, the list must have a single
    time. Raises TableError.
    """
    found = [i for i, one in enumerate(times) if time is None or one.startswith(str(time).strip())]
    if len(found) == 1:
        return found[0]
    state = "several times" if time is None else f"no time {time}" if not found else f"several times {time}"
    raise TableError(
        f"{path} has {state}; it has {len(times)} times from {times[0]} to {times[-1]}; choose one with the key time"
    )


def check_height(path, sea, height):
    """Raise TableError if the height of a Sea differs from the height stated in its file, m (NaN if unknown)"""
    read = float(sea.spectrum.significant_height)
    if np.isfinite(height) and height > 0 and abs(read / height - 1) > OFF:
        raise TableError(
            f"{path}: 4√m₀ of its spectrum is {read:.4g} m, but the significant height in the file is "
            f"{height:.4g} m; allowed: a difference of up to {100 * OFF:g} %; a unit, a column or a part of "
            "the band was misread"
        )


def _held(path, sea, height):
    check_height(path, sea, height)
    return sea


def _plain(path, frequency, density):
    try:
        kept = frequency > 0
        return Sea(tabulated(2 * np.pi * frequency[kept], density[kept] / (2 * np.pi), Path(path).stem))
    except ValueError as error:
        raise TableError(f"{path}: {error}") from None


def _spread(path, frequency, density, spread, x_axis):
    """Sea of densities (n,) m²/Hz and spread (n, ROWS) 1/rad; long-crested towards 0 without x_axis"""
    if x_axis is None:
        return _plain(path, frequency, density)
    return _plane(path, frequency, directions.towards(x_axis), density[:, None] * spread)


def _plane(path, frequency, angle, density):
    """Sea of density (n, m) m²/Hz/rad"""
    try:
        return two_dimensional(2 * np.pi * frequency, angle, density / (2 * np.pi), Path(path).stem)
    except ValueError as error:
        raise TableError(f"{path}: {error}") from None


def _no_axis(path):
    return TableError(f"{path}: directions are nautical; give the compass heading of the x axis (x_axis_compass_deg)")


def _row(path, text, time, of_density=True):
    """Frequencies (n,) Hz and values (n,) of one row of a file of NDBC.  Raises TableError."""
    lines = [line for line in text.splitlines() if line.strip()]
    rows = [line for line in lines[1:] if not line.lstrip().startswith("#")]
    head = [word for word in lines[0].split() if re.fullmatch(r"\d*\.\d+", word)]
    paired = "(" in lines[-1]
    if of_density and (re.search(r"alpha[12]_|r[12]_1", lines[0]) or re.fullmatch(r".{5}[dijk]\d{4}.*", path.name)):
        raise TableError(
            f"{path} contains directions or moments; give the file of spectral densities of the same buoy, w… or "
            ".data_spec"
        )
    if not paired and len(head) < 3:
        named = ", ".join(word for word in lines[0].lstrip("#").split() if word in ("WVHT", "DPD", "APD", "MWD"))
        more = f" but heights and periods ({named}): give height, a period and a direction" if named else ""
        raise TableError(f"{path} has no densities by frequency{more}; allowed: NDBC's spectra, w… or .data_spec")
    first = 5 if paired else len([word for word in lines[0].split() if word != "#"]) - len(head)
    row = _row_of_time(path, rows, first, time)
    try:
        if paired:
            pairs = re.findall(r"([-+.\deE]+)\s*\(\s*([-+.\deE]+)\s*\)", row)
            values, frequency = np.array(pairs, float).reshape(-1, 2).T
        else:
            values, frequency = np.array(row.split()[first:], float), np.array(head, float)
    except ValueError as error:
        raise TableError(f"{path}: {error}") from None
    if len(values) != len(frequency) or len(frequency) < 3:
        raise TableError(
            f"{path}: {len(frequency)} frequencies and {len(values)} densities; allowed: the same number, at least 3"
        )
    return frequency, values


def _row_of_time(path, rows, words, time):
    """The row whose first words are a time, the only one if time is None.  Raises TableError."""
    times = [" ".join(row.split()[:words]) for row in rows]
    if time is not None:
        rows = [row for row, one in zip(rows, times, strict=True) if one == " ".join(str(time).split())]
    if len(rows) != 1:
        state = f"{len(rows)} rows" if time is None else f"{len(rows)} rows of time {time}"
        known = f", of {times[0]} to {times[-1]}" if times else ""
        raise TableError(f"{path} has {state}; choose one with time = 'YYYY MM DD hh mm'{known}")
    return rows[0]


def _measured(path, frequency, density, time):
    """Densities (n,) of a row, 0 beyond the band that was measured.  Raises TableError for a gap within it."""
    missing = density >= MISSING
    row = "its row" if time is None else f"its row of {time}"
    if missing.all():
        raise TableError(f"{path}: {row} has no measured density, all are {MISSING:g}; choose another time")
    first, last = np.flatnonzero(~missing)[[0, -1]]
    gaps = int(missing[first : last + 1].sum())
    if gaps:
        raise TableError(
            f"{path}: {row} has {gaps} densities of {MISSING:g}, which means no value, from {frequency[first]:g} to "
            f"{frequency[last]:g} Hz; choose another time, or fill these densities"
        )
    return np.where(missing, 0.0, density)


def _times(text):
    return [" ".join(line.split()[:5]) for line in text.splitlines()[1:] if line.strip() and line[0] != "#"]


def _directions_beside(path):
    """Files of α₁, α₂, r₁, r₂ beside one of densities of NDBC, None where one is missing"""
    if path.suffix == ".data_spec":
        found = [path.with_suffix(ending) for ending in DAYS]
    elif parts := re.fullmatch(r"(.{5})w(\d{4}.*)", path.name):
        found = [path.with_name(f"{parts[1]}{letter}{parts[2]}") for letter in "dijk"]
    else:
        return None
    return found if all(place.exists() for place in found) else None
