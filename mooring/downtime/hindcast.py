"""A multi-year record of weather: waves of one or several systems, wind, current, level, ice, at equal steps with gaps.

A missing value is nan.  A hindcast has no waves where the sea is frozen, so hours with ice and without waves count
as calm.  Missing hours are excluded from all shares, and they end a weather window.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from ..environment.tables import TableError
from .clock import check_rising

CODES = -9.0, -99.0, -999.0, -9999.0, -99.9, -99.99, 99.0, 99.9, 99.99, 999.0, 999.9, 9999.0, -32767.0, -32768.0
RANGES = {  # plausible ranges in SI; values outside are codes for missing data or have another unit
    "height": (0.0, 30.0), "period": (0.0, 40.0), "direction": (-2 * np.pi, 4 * np.pi), "speed": (0.0, 100.0),
    "component": (-100.0, 100.0), "level": (-25.0, 25.0), "share": (0.0, 1.0),
}  # fmt: skip
CALM = 0.005  # m, of height
FEWEST = 24  # rows
DAYS = np.array([31, 28.25, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31])  # of each month
MONTHS = (
    "January", "February", "March", "April", "May", "June", "July", "August", "September", "October", "November",
    "December",
)  # fmt: skip
UNEVEN = 1.5  # times as much of one month as of another, from which means over the year are lopsided


class WaveHours(NamedTuple):
    """A wave system, each (n,): significant height, m; period, s; direction of travel in axes of the body, rad"""

    height: np.ndarray
    period: np.ndarray
    direction: np.ndarray


@dataclass(frozen=True, eq=False)
class Hindcast:
    """time : (n,) datetime64[s], UTC, ascending; step : s; waves : WaveHours of each system; columns : {name: (n,)}
    in SI
    said : remarks on gaps, codes, calms, ice, seasons
    """

    time: np.ndarray
    step: float
    waves: tuple[WaveHours, ...]
    columns: dict = field(default_factory=dict)
    said: tuple[str, ...] = ()

    def __repr__(self):
        return f"<Hindcast {len(self.time)} rows of {self.step / 3600:g} h, {self.time[0]} to {self.time[-1]}>"

    @property
    def hours(self):
        """Time between rows, h"""
        return self.step / 3600

    @property
    def year(self):
        """Year of each row; shape (n,)"""
        return self.time.astype("datetime64[Y]").astype(int) + 1970

    @property
    def month(self):
        """Month of each row, 1 to 12; shape (n,)"""
        return self.time.astype("datetime64[M]").astype(int) % 12 + 1

    @property
    def height(self):
        """Height of all systems together, m, the root of the sum of squares; shape (n,); nan if one is missing"""
        return np.sqrt(sum(one.height**2 for one in self.waves))

    @property
    def main(self):
        """WaveHours of the system of the largest height in each row"""
        highest = np.argmax([np.nan_to_num(one.height) for one in self.waves], axis=0)[None]
        return WaveHours(*(np.take_along_axis(np.array(part), highest, 0)[0] for part in zip(*self.waves, strict=True)))

    @property
    def slot(self):
        """Index of each row, counted in steps from the first row; shape (n,); a gap skips indices"""
        return np.round((self.time - self.time[0]).astype(float) / self.step).astype(int)


def made(time, waves, columns, where):
    """The Hindcast of columns as read, in SI: gaps, codes of missing values, calms and ice are found and reported.

    where : name of the file.  Raises TableError for times that are not ascending or have no common step, and for
        impossible values.
    """
    if len(time) < FEWEST:
        raise TableError(
            f"{where} has {len(time)} rows; allowed: at least {FEWEST}, preferably all hours of several years"
        )
    if np.all(np.diff(time) < np.timedelta64(0, "s")):  # the newest first
        time, waves = time[::-1], [tuple(part[::-1] for part in one) for one in waves]
        columns = {name: (values[::-1], kind) for name, (values, kind) in columns.items()}
    check_rising(time, where)
    steps = np.diff(time).astype(float)
    step = float(np.median(steps))
    count = steps / step
    if np.any(np.abs(count - np.round(count)) > 1e-6) or np.any(count < 1):
        at = int(np.argmax(np.abs(count - np.round(count))))
        raise TableError(f"{where}: the step after {time[at]} is {steps[at] / 3600:.4g} h and the other steps are "
                         f"{step / 3600:g} h; allowed: equal steps; a gap must be a whole number of steps")  # fmt: skip
    said = [*_gaps(time, np.round(count).astype(int), step)]
    waves = [WaveHours(*(_cleaned(f"{kind} of waves", part, kind, where, said) for kind, part in
                         zip(("height", "period", "direction"), one, strict=True))) for one in waves]  # fmt: skip
    columns = {name: _cleaned(name, values, kind, where, said) for name, (values, kind) in columns.items()}
    waves = _calms(waves, columns.get("ice"), said)
    time, step, waves, columns = _of_waves(time, step, waves, columns, said)
    lost = np.mean(np.any([~np.isfinite(one.height) for one in waves], axis=0)) if waves else 0.0
    if lost > 0:
        said.append(f"{100 * lost:.3g} % of the rows have no waves; they are excluded from all shares")
    found = Hindcast(time, step, tuple(waves), columns)
    return replace(found, said=(*said, *_seasons(found)))


def _seasons(found):
    """One line on months of the year that the rows leave out, or have far more often than others"""
    known = np.all([np.isfinite(one.height) for one in found.waves], axis=0) if found.waves else slice(None)
    days = np.bincount(found.month[known], minlength=13)[1:] * found.hours / 24 / DAYS  # in months of each name
    none = [name for name, share in zip(MONTHS, days, strict=True) if share == 0]
    if none:
        named = ", ".join(none)
        yield (
            f"the record has no rows of {named}: hours a year and all shares represent the other months only; give "
            "whole years"
        )
    elif days.max() > UNEVEN * days.min():
        most, least = (MONTHS[int(pick(days))] for pick in (np.argmax, np.argmin))
        yield (
            f"the record has {days.max():.2g} months of {most} and {days.min():.2g} of {least}: hours a year "
            f"and all shares give {most} too much weight; give whole years"
        )


def _of_waves(time, step, waves, columns, said):
    """Of a record whose waves come more seldom than its rows, as those of a buoy beside the wind, the rows of waves"""
    some = np.flatnonzero(np.all([np.isfinite(one.height) for one in waves], axis=0)) if waves else np.zeros(0, int)
    every = round(float(np.median(np.diff(time[some]).astype(float))) / step) if len(some) >= FEWEST else 1
    if every < 2:
        return time, step, waves, columns
    kept = np.flatnonzero(np.round((time - time[some[0]]).astype(float) / step).astype(int) % every == 0)
    said.append(f"waves come every {every * step / 3600:g} h; the {len(time) - len(kept)} rows in between are not used")
    waves = [WaveHours(*(part[kept] for part in one)) for one in waves]
    return time[kept], every * step, waves, {name: values[kept] for name, values in columns.items()}


def _gaps(time, count, step):
    missing = int((count - 1).sum())
    if missing:
        at, places = int(np.argmax(count)), int(np.sum(count > 1))
        yield (
            f"{missing} of {missing + len(time)} steps are missing, in {places} gaps, the longest of "
            f"{(count[at] - 1) * step / 3600:.4g} h after {time[at]}: they are excluded from all shares, and "
            f"weather windows end there"
        )


def _cleaned(name, values, kind, where, said):
    """Values with codes of what is missing as nan.  Raises TableError for others beyond the range of their kind."""
    values, (low, high) = np.array(values, float), RANGES.get(kind, (-np.inf, np.inf))
    beyond = np.flatnonzero((values < low) | (values > high))
    if not len(beyond):
        return values
    codes = {c for code in CODES for c in ((np.radians(code),) if kind == "direction" else (code,))}
    strange = [v for v in np.unique(values[beyond]) if not np.any(np.isclose(v, list(codes), rtol=1e-6))]
    if strange:
        worst = strange[-1] if abs(strange[-1]) >= abs(strange[0]) else strange[0]
        raise TableError(
            f"{where}: {name} is {worst:.6g} in {int(np.sum(values == worst))} rows; allowed: {low:.4g} to {high:.4g} "
            "in SI, or a code for missing data such as -999; if the unit is another, name it in the header, "
            'such as "hs [cm]"'
        )
    said.append(f"{len(beyond)} values of {name} are taken as codes for missing data, such as {values[beyond[0]]:g}")
    values[beyond] = np.nan
    return values


def _calms(waves, ice, said):
    """The waves with calms, whose period and direction do not matter, and hours of ice without waves, as nil"""
    out, calm_rows, ice_rows = [], 0, 0
    for one in waves:
        height = one.height.copy()
        frozen = np.isnan(height) & (np.nan_to_num(ice) > 0) if ice is not None else np.zeros(len(height), bool)
        height[frozen] = 0.0
        calm = height < CALM
        wrong = (height >= CALM) & ~((one.period > 0) & np.isfinite(one.direction))
        height[wrong] = np.nan
        calm_rows, ice_rows = calm_rows + int((calm & ~frozen).sum()), ice_rows + int(frozen.sum())
        height[calm] = 0.0
        quiet = ~(height > 0)
        out.append(WaveHours(height, np.where(quiet, np.nan, one.period), np.where(quiet, 0.0, one.direction)))
    if ice_rows:
        said.append(f"{ice_rows} rows have ice and no waves; they count as calm")
    if calm_rows:
        said.append(f"{calm_rows} rows are calm, with waves below {CALM:g} m")
    return out
