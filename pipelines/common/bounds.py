"""What a command will take, against what there is: refused before any work is done, in one line with the way out.

Estimates are within a factor of three or so; what is refused would take far more than anybody has.
"""

from __future__ import annotations

import math
import sys
import time
from pathlib import Path

from .progress import duration

LONGEST = 30 * 86400.0  # s
WORTH_TELLING = 10.0  # s
MUCH = 1e9  # bytes
LITTLE = 1e8  # bytes below which free memory is not checked; the check takes 0.01 s
MOST = 10_000  # numbers of one list or span


class TooMuchError(ValueError):
    """A command would take more memory or time than there is; one line says how much, and what helps."""


def check_memory(what, needed, way_out, error=TooMuchError):
    """Raise `error` where more bytes are needed than are free.

    what : of the question, with its verb, as "5000 panels need"; way_out : "give fewer panels (--panels)"
    """
    if needed > LITTLE and needed > (free := available_memory()):
        raise error(f"{what} about {needed / 1e9:.3g} GB, and {free / 1e9:.1f} GB are free; {way_out}")


def check_seconds(what, seconds, way_out, error=TooMuchError):
    """Raise `error` for work of more than LONGEST; arguments as of `check_memory`, as "5000 sections take"."""
    if not seconds <= LONGEST:
        raise error(f"{what} about {duration(seconds)}; allowed: {duration(LONGEST)}; {way_out}")


def told(what, seconds, say=None, memory=0.0):
    """Say what work of WORTH_TELLING or more, or of MUCH memory (bytes), will take, to stderr unless elsewhere."""
    if seconds >= WORTH_TELLING or memory >= MUCH:
        (say or _to_stderr)(
            f"{what} about {duration(seconds)}" + (f", {memory / 1e9:.2g} GB" if memory >= MUCH else "")
        )


def check_count(key, count, least=1, most=MOST, error=TooMuchError):
    """Raise `error` unless a list or a span has as many numbers as are allowed."""
    if not least <= count <= most:
        raise error(f"{key} has {count} numbers; allowed: {least} to {most}")


def whole_number(flag, text, least=0, otherwise=None):
    """The whole number that a flag has, below 10^15, or `otherwise` where it has no text.  Raises ValueError."""
    if text is None:
        return otherwise
    if not (text.isdecimal() and text.isascii() and len(text) <= 15) or int(text) < least:
        shown = text if len(text) <= 40 else f"{text[:40]}…"
        raise ValueError(f"--{flag} is {shown!r}; allowed: a whole number from {least}, of at most 15 digits")
    return int(text)


class Pace:
    """Tells what equal pieces of work will take together, once their pace is known, and refuses what is too long."""

    FIRST, EVERY = 1.0, 10.0  # s

    def __init__(self, what, total, way_out, say=None):
        """what : of all pieces, with its verb, as "5000 sections take"; way_out : as of `check_seconds`"""
        self.what, self.total, self.way_out, self.say = what, total, way_out, say or _to_stderr
        self.done, self.begin, self.spoken = 0, 0.0, None

    def step(self):
        """One more piece is done.  Raises TooMuchError."""
        self.done += 1
        now = time.perf_counter()
        if self.done == 1:  # the first piece also loads and compiles
            self.begin = now
        if now - self.begin < self.FIRST or (self.spoken and now - self.spoken < self.EVERY):
            return
        seconds = (now - self.begin) / (self.done - 1) * self.total
        if self.spoken is None:
            check_seconds(self.what, seconds, self.way_out)
            told(self.what, seconds, self.say)
        elif seconds >= WORTH_TELLING:
            self.say(f"{self.done} of {self.total}, {duration(seconds - (now - self.begin))} left")
        self.spoken = now


def _to_stderr(text):
    print(text, file=sys.stderr, flush=True)


def available_memory():
    """Bytes that can be had without swapping, of the machine or of the container that the process is in"""
    import psutil

    return min(float(psutil.virtual_memory().available), _left_to_container())


def _left_to_container(place=Path("/sys/fs/cgroup")):
    """Bytes below the limit of Linux' control group (version 2), its file cache counted as free; infinite without one

    place : folder of the process's group, as seen from inside a container
    """
    try:
        limit, used = (float((place / name).read_text()) for name in ("memory.max", "memory.current"))
        stat = dict(line.split() for line in (place / "memory.stat").read_text().splitlines())
    except (OSError, ValueError):  # no such group, or its limit is the word "max"
        return math.inf
    return limit - used + float(stat.get("inactive_file", 0)) + float(stat.get("active_file", 0))
