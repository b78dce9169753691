"""Two-dimensional spectra of WAVEWATCH III, in the text file that its program ww3_outp writes (type 1, transfer file).

    'WAVEWATCH III SPECTRA'  NK NTH NPTS 'name'
    NK frequencies, Hz;  NTH directions, rad
    yyyymmdd hhmmss
    'point' latitude longitude depth wind speed and direction, current speed and direction     NPTS times,
    NK NTH densities, m²/Hz/rad, frequencies of a direction one after the other                for each time

Directions are those in which waves travel, clockwise from north. If the x axis points to the compass heading ψ, β =
ψ − direction.
"""

import re

import numpy as np

from ..environment.tables import TableError

HEAD = "'WAVEWATCH III SPECTRA'"
MOST = 4000  # frequencies, or directions
PLACE = 7  # numbers after the name of a point


def read_wavewatch(path, text, x_axis, time, location):
    """omega (n,) rad/s, direction of travel (m,) rad and density (n, m) m² s/rad² at one time and point of a file's
    text

    x_axis : compass heading of the x axis, degrees; time : "yyyymmdd hhmmss", None for the only time
    location : number of the point, counted from 1
    raises : TableError
    """
    if x_axis is None:
        raise TableError(
            f"{path}: directions are nautical; give the compass heading of the x axis (x_axis_compass_deg)"
        )
    words = re.findall(r"'[^']*'|[^\s']+", text[text.index(HEAD) + len(HEAD) :])
    frequencies, directions, points = (_whole(path, word) for word in words[:3])
    if not 1 <= location <= points:
        raise TableError(f"{path} has {points} points, and location is {location}; allowed: 1 to {points}")
    words = words[4:]
    axes = _numbers(path, words[: frequencies + directions], frequencies + directions, "frequencies and directions")
    words, size = words[frequencies + directions :], frequencies * directions
    block = 2 + points * (1 + PLACE + size)
    if not words or len(words) % block:
        raise TableError(f"{path}: {len(words)} words follow the directions; expected: {block} for each time")
    times = [f"{words[i]} {words[i + 1]}" for i in range(0, len(words), block)]
    if time is None and len(times) > 1:
        raise TableError(f"{path} has {len(times)} times, the first is {times[0]}; choose one with time")
    if time is not None and str(time) not in times:
        raise TableError(f"{path} has no time {time}; it has {', '.join(times[:6])}")
    first = block * (0 if time is None else times.index(str(time))) + 2
    first += (location - 1) * (1 + PLACE + size) + 1 + PLACE
    values = _numbers(path, words[first : first + size], size, "densities")
    density = values.reshape(directions, frequencies).T / (2 * np.pi)
    return 2 * np.pi * axes[:frequencies], np.radians(x_axis) - axes[frequencies:], density


def _whole(path, word):
    if not word.isdecimal() or not 1 <= int(word) <= MOST:
        raise TableError(
            f"{path}: its header has {word!r}; expected: the numbers of frequencies, directions and points"
        )
    return int(word)


def _numbers(path, words, count, thing):
    try:
        found = np.array([float(word) for word in words])
    except ValueError:
        wrong = next(word for word in words if not re.fullmatch(r"[-+]?\d*\.?\d*([eEdD][-+]?\d+)?", word))
        raise TableError(f"{path} has {wrong!r}; expected: numbers, the {thing}") from None
    if len(found) != count or not np.all(np.isfinite(found)):
        raise TableError(f"{path} has {len(found)} {thing}; expected: {count}, all finite")
    return found
