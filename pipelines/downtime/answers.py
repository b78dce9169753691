"""Hours of downtime by year, month, direction and cause, windows of weather and waiting, as quantities of a result."""

from typing import NamedTuple

import numpy as np

from hakobune.mooring.downtime.largest import return_values
from hakobune.mooring.downtime.windows import in_windows, waiting, windows
from hakobune.mooring.downtime.years import by_group, share_with_interval

from ..results.quantity import Quantity
from ..results.result import labels, records

YEAR = 8766.0  # h
ALL, MONTHS, YEARS, SECTORS = "downtime", "downtime by month", "downtime by year", "downtime by direction of the waves"
CAUSE, WINDOW, WAIT = "causes of downtime", "weather windows", "waiting for a window"
NAMES = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
SECTOR = 30.0  # degrees
DIRECTIONS = np.arange(0.0, 360.0, 10.0)  # degrees of the compass, of limiting seas
PERIODS = 24
RETURN = "largest responses"
FEW = 12  # years that are printed
NORMAL = 1.645  # standard deviations of an interval of 90 %


class Verdicts(NamedTuple):
    """known, down : over hours and operations, (n, o); chance : probability that an operation stops in an hour, (n,
    o), 0 or 1 if certain

    used, beyond : (n, l) utilisation of each limit, and the probability that it is exceeded
    error : standard deviation of the sum of probabilities, as a share of time, without the scatter of years, (o,)
    """

    known: np.ndarray
    down: np.ndarray
    chance: np.ndarray
    used: np.ndarray
    beyond: np.ndarray
    error: np.ndarray


def judged(used, limits, operations):
    """Verdicts for utilisations (n, l) without uncertainty; the verdict of an hour is known if all limits of the
    operation are known"""
    down, known = [], []
    for number in range(operations):
        own = used[:, [one.operation == number for one in limits]]
        known.append(np.isfinite(own).all(axis=1) | np.isposinf(own).any(axis=1))
        down.append((own > 1).any(axis=1) & known[-1])
    down, known = np.stack(down, axis=1), np.stack(known, axis=1)
    return Verdicts(known, down, down.astype(float), used, (used > 1).astype(float), np.zeros(operations))


def answers(study, hindcast, limits, verdicts):
    """{name: Quantity} and {axis: labels} of a DowntimeStudy from Verdicts on the hours of a Hindcast"""
    names = [one.name for one in study.operations]
    down, known, chance = verdicts.down, verdicts.known, verdicts.chance
    years = np.unique(hindcast.year)
    made, axes = _whole(chance, known, hindcast, years, verdicts.error), dict(labels("operation", names))
    axes |= labels("year", years) | labels("month", NAMES)
    axes |= labels("limit", [one.label for one in limits])
    made |= _causes(known, verdicts, limits)
    made |= _by_month(chance, known, hindcast, years) | _by_year(chance, known, hindcast, years)
    found, more = _by_sector(study, chance, known, hindcast, years)
    made, axes = made | found, axes | more
    found, more = _windows(study, down, known, hindcast, years)
    return made | found, axes | more


def _three(head, table, axes, three, words, unit="", share=True):
    """Quantities of a value and the ends of its interval, printed if there are any"""
    parts = zip(("share", "low", "high") if share else ("mean", "low", "high"), ("", "90 % from", "90 % to"), three,
                strict=True)  # fmt: skip
    return {
        f"{head}.{part}": Quantity(
            values, axes, unit, said or words, table if np.any(np.isfinite(values)) else "", share
        )
        for part, said, values in parts
    }


def _whole(chance, known, hindcast, years, error):
    three = share_with_interval(*by_group(chance, known, hindcast.year, years))
    if error.any():  # uncertainty of these hours, in addition to the scatter of years
        share, *ends = three
        three = (
            share,
            *(
                np.clip(share + s * np.hypot(end - share, NORMAL * error), 0, 1)
                for s, end in zip((-1, 1), ends, strict=True)
            ),
        )
    hours = {"hours": three[0], "hours_low": three[1], "hours_high": three[2]}
    words = ("hours a year", "hours a year, 90 % from", "hours a year, 90 % to")
    made = {
        f"downtime.{part}": Quantity(
            YEAR * values, ("operation",), "h", said, ALL if np.any(np.isfinite(values)) else ""
        )
        for (part, values), said in zip(hours.items(), words, strict=True)
    }
    made |= _three("downtime", ALL, ("operation",), three, "of the time")
    made["downtime.known"] = Quantity(known.mean(axis=0), ("operation",), "", "rows with data", "", True)
    return made


def _causes(known, verdicts, limits):
    """Hours per year beyond each limit, and those in which this limit alone stops its operation"""
    beyond, alone, used = [], [], verdicts.used
    for k, one in enumerate(limits):
        others = [j for j, other in enumerate(limits) if other.operation == one.operation and j != k]
        here = verdicts.beyond[:, k] * known[:, one.operation]
        rest = np.prod(1 - verdicts.beyond[:, others], axis=1)
        count = max(known[:, one.operation].sum(), 1)
        beyond.append(YEAR * here.sum() / count)
        alone.append(YEAR * (here * rest).sum() / count)
    most = np.nanmax(np.where(np.isinf(used), np.nan, used), axis=0, initial=0.0)
    return {
        "cause.hours": Quantity(beyond, ("limit",), "h", "hours a year", CAUSE),
        "cause.alone": Quantity(alone, ("limit",), "h", "this limit alone", CAUSE),
        "cause.most": Quantity(most, ("limit",), "", "most used", CAUSE, True),
    }


def _by_month(down, known, hindcast, years):
    keys = (12 * years[:, None] + np.arange(1, 13)).ravel()
    sums = by_group(down, known, 12 * hindcast.year + hindcast.month, keys)
    three = share_with_interval(*(one.reshape(len(years), 12, -1) for one in sums))
    return _three("month", MONTHS, ("month", "operation"), three, "down,")


def _by_year(down, known, hindcast, years):
    above, below = by_group(down, known, hindcast.year, years)
    with np.errstate(invalid="ignore"):
        share = above / below
    shown = YEARS if len(years) <= FEW else ""  # a longer list is in the picture, the page and the file only
    return {"year.share": Quantity(share, ("year", "operation"), "", "down,", shown, True)}


def sector_of(study, hindcast):
    """Compass sector from which the highest wave system comes, −1 for a calm; shape (n,)"""
    main = hindcast.main
    comes_from = study.hindcast.x_axis_compass_deg - np.degrees(main.direction) - 180.0
    sector = np.floor(np.mod(comes_from + SECTOR / 2, 360.0) / SECTOR).astype(int)
    return np.where(main.height > 0, sector, -1)


def _by_sector(study, down, known, hindcast, years):
    count, sector = round(360 / SECTOR), sector_of(study, hindcast)
    place = (count + 1) * np.searchsorted(years, hindcast.year) + sector + 1
    keys = np.arange((count + 1) * len(years))
    above, below = (one.reshape(len(years), count + 1, -1)[:, 1:] for one in by_group(down, known, place, keys))
    all_of_it = by_group(down, known, hindcast.year, years)[1][:, None]
    hours = YEAR * above.sum(axis=0) / np.maximum(all_of_it.sum(axis=0), 1)
    share = below.sum(axis=0)[:, 0] / max(all_of_it.sum(axis=0)[0, 0], 1)
    made = {
        "sector.time": Quantity(share, ("sector",), "", "of the time", SECTORS, True),
        "sector.hours": Quantity(hours, ("sector", "operation"), "h", "hours a year", SECTORS),
    }
    return made, labels("sector", [f"{SECTOR * i:.0f}°" for i in range(count)], description="waves from")


def _windows(study, down, known, hindcast, years):
    lengths, slot, hours = study.windows_hours, hindcast.slot, hindcast.hours
    share, often = np.zeros((len(lengths), down.shape[1])), np.zeros((len(lengths), down.shape[1]))
    wait, late = np.full((3, 12, down.shape[1]), np.nan), np.full((12, down.shape[1]), np.nan)
    for o, operation in enumerate(study.operations):
        found = windows(~down[:, o], known[:, o], slot)
        count = max(known[:, o].sum(), 1)
        for k, length in enumerate(lengths):
            steps = max(1, int(np.ceil(length / hours - 1e-9)))
            share[k, o] = in_windows(found, len(slot), steps).sum() / count
            often[k, o] = (found.steps >= steps).sum() / (count * hours / YEAR)
        steps = max(1, int(np.ceil(operation.window_hours / hours - 1e-9)))
        waited = hours * waiting(found, known[:, o], slot, steps)
        wait[..., o], late[:, o] = _by_arrival(waited, hindcast, years)
    needs = ", ".join(f"{one.name} {one.window_hours:g} h" for one in study.operations)
    made = {
        "window.share": Quantity(share, ("window", "operation"), "", "of the time in such windows, ", WINDOW, True),
        "window.often": Quantity(often, ("window", "operation"), "1/year", "a year,", WINDOW),
        **_three("wait", WAIT, ("month", "operation"), wait, "mean,", unit="h", share=False),
        "wait.late": Quantity(
            late, ("month", "operation"), "h", f"not exceeded by nine in ten arrivals ({needs}),", ""
        ),
    }
    return made, labels("window", np.array(lengths), "h", "at least")


def _by_arrival(waited, hindcast, years):
    """Mean wait with its interval, and what nine of ten arrivals wait at most, by month of the arrival; shapes (3, 12)
    and (12,)"""
    sure = np.isfinite(waited)
    keys = (12 * years[:, None] + np.arange(1, 13)).ravel()
    place = np.searchsorted(keys, 12 * hindcast.year + hindcast.month)
    total, count = (
        np.bincount(place, w, len(keys)).reshape(len(years), 12) for w in (np.where(sure, waited, 0.0), sure)
    )
    late = [np.quantile(waited[sure & (hindcast.month == m)], 0.9) if np.any(sure & (hindcast.month == m)) else np.nan
            for m in range(1, 13)]  # fmt: skip
    return np.stack(share_with_interval(total, count, most=np.inf)), np.array(late)


def of_years(names, units, years, maxima, period):
    """Return values of responses by `largest.return_values`, once in `period` years, with their yearly maxima (r, y) in
    whole years (y,); names, units : (r,).  returns : quantities and labels"""
    value, low, high = return_values(maxima.T, period)
    shown = RETURN if np.any(np.isfinite(value)) else ""
    made = {
        "return.value": Quantity(value, ("response",), units, f"once in {period:g} years", shown),
        "return.low": Quantity(low, ("response",), units, "90 % from", shown),
        "return.high": Quantity(high, ("response",), units, "90 % to", shown),
        **records({"return.maxima": (maxima, ("response", "whole_year"), units, "largest of each year, as drawn")}),
    }
    return made, labels("response", names) | labels("whole_year", years)
