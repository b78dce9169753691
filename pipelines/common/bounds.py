"""Memory and time that a command needs, compared with what is available. A command that needs too much is refused
before the computation, in one line with a remedy.

Estimates are correct within a factor of about three; refused work would not fit on any available machine.
"""

import math
import sys
import time
from pathlib import Path

from hakobune.bem.kernels.progress import LONG

from .progress import duration

LONGEST = 30 * 86400.0  # s
WORTH_TELLING = 10.0  # s
MUCH = 1e9  # bytes
# s a frequency and pair of nodes on a slow processor, 8e-8 on a quick one: what takes long by it is measured
SLOWEST = 5e-7
LITTLE = 1e8  # bytes below which free memory is not checked; the check takes 0.01 s
MOST = 10_000  # largest length of one list or span


class TooMuchError(ValueError):
    """A command would take more memory or time than available; the message gives the amount and a remedy."""


def check_memory(what, needed, way_out, error=TooMuchError):
    """Raise `error` where more bytes are needed than are free.

    what : subject and verb, such as "5000 panels need"; way_out : "give fewer panels (--panels)"
    """
    if needed > LITTLE and needed > (free := available_memory()):
        raise error(f"{what} about {needed / 1e9:.3g} GB, and {free / 1e9:.1f} GB are free; {way_out}")


def check_seconds(what, seconds, way_out, error=TooMuchError):
    """Raise `error` for work that takes longer than LONGEST; what : such as "5000 sections take"; way_out : as in
    `check_memory`.
    """
    if not seconds <= LONGEST:
        raise error(f"{what} about {duration(seconds)}; allowed: {duration(LONGEST)}; {way_out}")


def told(what, seconds, say=None, memory=0.0):
    """Report the time and memory of work that takes WORTH_TELLING or longer, or MUCH memory (bytes); by default to
    stderr.
    """
    if seconds >= WORTH_TELLING or memory >= MUCH:
        (say or _to_stderr)(
            f"{what} about {duration(seconds)}" + (f", {memory / 1e9:.2g} GB" if memory >= MUCH else "")
        )


class LongWaves:
    """Callback of `bem.kernels.progress`: reports the time that forces of bound long waves on panels take, and the
    time left

    say : function that is called with each line; by default lines go to stderr
    """

    EVERY = 10.0  # s

    def __init__(self, say=None):
        self.say, self.started, self.told = say or _to_stderr, 0.0, 0.0

    def __call__(self, stage, what):
        if stage != LONG:
            return
        prepared, omega, done, count = what
        if done == 0:
            from hakobune.bem.panels.band.cost import memory_alone, seconds_alone

            panels = prepared.problem.mesh.total
            seconds = count * SLOWEST * (4 * panels) ** 2
            if seconds >= WORTH_TELLING:  # measuring compiles kernels for a second
                seconds = count * seconds_alone(prepared, max(omega, 1e-3))
            what = f"forces of bound long waves, {count} frequencies on {panels} panels:"
            told(what, seconds, self.say, memory_alone(prepared))
            self.started = self.told = time.perf_counter()
        elif (now := time.perf_counter()) - self.told >= self.EVERY:
            self.told, left = now, (now - self.started) / done * (count - done)
            self.say(f"forces of bound long waves: {done} of {count} frequencies, {duration(left)} left")


def check_count(key, count, least=1, most=MOST, error=TooMuchError):
    """Raise `error` unless the length of a list or a span is within its limits."""
    if not least <= count <= most:
        raise error(f"{key} has {count} numbers; allowed: {least} to {most}")


def whole_number(flag, text, least=0, otherwise=None):
    """The integer that is given to a flag, below 10^15, or `otherwise` for an empty text.  Raises ValueError."""
    if text is None:
        return otherwise
    if not (text.isdecimal() and text.isascii() and len(text) <= 15) or int(text) < least:
        shown = text if len(text) <= 40 else f"{text[:40]}…"
        raise ValueError(f"--{flag} is {shown!r}; allowed: a whole number from {least}, of at most 15 digits")
    return int(text)


class Pace:
    """Estimates the total time of equal pieces of work from the first pieces, and refuses work that is too long."""

    FIRST, EVERY = 1.0, 10.0  # s

    def __init__(self, what, total, way_out, say=None):
        """what : all pieces, with a verb, such as "5000 sections take"; way_out : as in `check_seconds`"""
        self.what, self.total, self.way_out, self.say = what, total, way_out, say or _to_stderr
        self.done, self.begin, self.spoken = 0, 0.0, None

    def step(self):
        """Count one more finished piece.  Raises TooMuchError."""
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
    """Memory, bytes, available without swapping on the machine or in the container of the process"""
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
