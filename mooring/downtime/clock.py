"""Times of a record in UTC, from ISO 8601 texts with or without an offset or summer time, or from seconds since 1970.

In autumn an hour of local time occurs twice: first in summer time, then in winter time. In spring an hour is
missing. A record marked UTC that has both a doubled and a missing hour is in local time.
"""

import datetime
import re
import zoneinfo

import numpy as np

from ..environment.tables import TableError

OFFSET = re.compile(r"(?:Z|([+-])(\d\d):?(\d\d))$")
HOUR, DAY = np.timedelta64(3600, "s"), 86400
ALLOWED = "UTC, an offset such as +09:00, or a name such as Europe/Berlin"


def times(texts, zone, where):
    """Times in UTC, datetime64[s], from ISO texts; shape (n,); zone : time zone of texts that state no offset from UTC.

    where : name of the file, for messages.  Raises TableError.
    """
    texts = np.char.strip(np.asarray(texts, str))
    if re.fullmatch(r"\d{9,10}(\.\d*)?", texts[0]) and np.all(np.char.isdecimal(np.char.replace(texts, ".", ""))):
        return texts.astype(float).astype("datetime64[s]")  # seconds since 1970
    found = OFFSET.search(texts[0][10:])
    if found:
        lengths = len(found[0])
        texts, ends = np.array([t[:-lengths] for t in texts]), [t[-lengths:] for t in texts]
        ahead = _offsets(ends, where)
        return _parsed(texts, where) - ahead
    local = _parsed(texts, where)
    if zone == "UTC":
        return local
    if re.fullmatch(r"[+-]\d\d:?\d\d", zone):
        return local - _offsets([zone], where)
    return _of_place(local, zone, where)


def _parsed(texts, where):
    try:
        return texts.astype("datetime64[s]")
    except ValueError:
        wrong = next(str(t) for t in texts if not re.match(r"\d{4}-\d\d-\d\d([T ]\d\d(:\d\d(:\d\d(\.0*)?)?)?)?$", t))
        raise TableError(f"{where}: time is {wrong!r}; allowed: ISO 8601, such as 2015-01-31T06:00") from None


def _offsets(ends, where):
    """Offsets from UTC, timedelta64[s], of "Z", "+09:00", …; shape (n,)"""
    known = {}
    for end in set(ends):
        found = OFFSET.fullmatch(end)
        if not found:
            raise TableError(
                f"{where}: the times have different time zones, one of them {end!r}; allowed: Z or the same offset "
                f"for all"
            )
        size = 0 if end == "Z" else (3600 * int(found[2]) + 60 * int(found[3])) * (-1 if found[1] == "-" else 1)
        known[end] = size
    return np.array([known[end] for end in ends]).astype("timedelta64[s]")


def _of_place(local, zone, where):
    try:
        place = zoneinfo.ZoneInfo(zone)
    except (ValueError, OSError, zoneinfo.ZoneInfoNotFoundError):
        raise TableError(f"{where}: zone is {zone!r}; allowed: {ALLOWED}") from None
    changes = list(_changes(place, local.min() - np.timedelta64(DAY, "s"), local.max() + np.timedelta64(DAY, "s")))
    first, *later = changes
    offset = np.full(len(local), first[2])
    for at, before, after in later:
        begin, end = at + min(before, after), at + max(before, after)
        offset[local >= end] = after
        between = np.flatnonzero((local >= begin) & (local < end))
        if after > before and len(between):
            raise TableError(
                f'{where}: {local[between[0]]} does not exist in {zone}, where clocks go forward; try zone = "UTC"'
            )
        _, once = np.unique(local[between], return_index=True)
        offset[between] = after
        offset[between[once]] = before
    return local - offset


def _changes(place, begin, end):
    """Changes of the offset: (time in UTC, offset before, offset after), datetime64[s] and timedelta64[s]; the one at
    the beginning comes first"""

    def offset(at):
        moment = datetime.datetime.fromtimestamp(int(at.astype(int)), datetime.UTC)
        return np.timedelta64(int(moment.astimezone(place).utcoffset().total_seconds()), "s")

    before = offset(begin)
    yield begin, before, before
    for at in np.arange(begin, end, np.timedelta64(DAY, "s")):
        day_after = offset(at + np.timedelta64(DAY, "s"))
        while day_after != before:
            while offset(at) == before:
                at += HOUR
            after = offset(at)
            yield at, before, after
            before = after


def check_rising(time, where):
    """Raises TableError for times (n,) that do not ascend; the message names the place and a probable cause such as
    local time.
    """
    rise = np.diff(time)
    back = np.flatnonzero(rise <= np.timedelta64(0, "s"))
    if not len(back):
        return
    months = set((time[back].astype("datetime64[M]").astype(int) % 12 + 1).tolist())
    same = np.abs(rise[back]) <= HOUR
    if same.all() and months <= {3, 4, 9, 10, 11}:
        raise TableError(
            f"{where}: {len(back)} hours are repeated, first {time[back[0]]}, all in spring or autumn: the file has "
            f"local time with summer time; give hindcast.zone: {ALLOWED}"
        )
    raise TableError(
        f"{where}: time does not increase after {time[back[0]]}, at {len(back)} places; allowed: increasing, "
        f"without repetition"
    )
