"""Lines that report the progress of a run."""

import math
import time
from itertools import takewhile

TRUST = 0.1  # share of a preparation over which its pace changes from the estimate to the measured one
ONCE = "reduction", "rankine"  # parts of a frequency's time that only the first frequency needs


class Progress:
    """Prints one line per frequency, with the remaining time estimated from the previous frequencies."""

    def __init__(self, console, total):
        self.console, self.total, self.done, self.started = console, total, 0, time.perf_counter()
        self.once = 0.0  # s, of work done once for all frequencies, by every process at the same time

    def step(self, where, result, reason):
        """where : ω in rad/s, or the name of a limit; result : result of the solver; reason : reason of a failure,
        or empty"""
        self.done += 1
        self.once = max(self.once, sum(times(result).get(part, 0.0) for part in ONCE))
        left = max(0.0, time.perf_counter() - self.started - self.once) / self.done * (self.total - self.done)
        place = where if isinstance(where, str) else f"ω {where:7.4f} rad/s  T {2 * math.pi / where:7.2f} s"
        took, rest = (" failed", reason) if reason else (_seconds(result), checks_text(result))
        line = (
            f"{self.done:{len(str(self.total))}}/{self.total}  {place:30}  {took:>9}  {duration(left):>8} left  {rest}"
        )
        self.console.print(line.rstrip(), highlight=False, markup=False, soft_wrap=True)


class Preparing:
    """Prints at intervals the progress of the preparation of a large body, and the remaining time."""

    EVERY = 10.0  # seconds

    def __init__(self, console, cost):
        """cost : `bem.panels.band.cost.Cost`"""
        self.console, self.stages, self.seconds = console, cost.stages, cost.seconds
        self.counts = dict.fromkeys(self.stages, 0.0)
        self.started = self.told = time.perf_counter()

    def __call__(self, stage, count):
        """`bem.kernels.progress.progress_callback`; the stages come one after the other"""
        for before in takewhile(lambda other: other != stage, self.stages):
            self.counts[before] = self.stages[before][0]  # guessed generously
        self.counts[stage] += count
        now = time.perf_counter()
        if now - self.told < self.EVERY:
            return
        self.told, share = now, self.share
        if share == 1.0:  # the coarser mesh, which follows, takes little time
            return
        trusted = TRUST * self.seconds
        pace = (now - self.started + trusted) / (share * self.seconds + trusted)
        text = f"preparing: {100 * share:3.0f} %  {duration((1 - share) * self.seconds * pace):>8} left"
        self.console.print(text, highlight=False, markup=False, soft_wrap=True)

    @property
    def share(self):
        """Finished share of the estimated time, 0 to 1"""
        done = sum(min(self.counts[stage], count) * seconds for stage, (count, seconds) in self.stages.items())
        return done / self.seconds


def times(result):
    """{step: s} of a solver's result, empty after a failure"""
    return result.get("wall_time", {}) if isinstance(result, dict) else {}


def _seconds(result):
    return f"{sum(times(result).values()):.2f} s" if times(result) else ""


def checks_text(result):
    """`reciprocity 2e-04  energy 1e-03` of a result's applicable checks."""
    checks = result.get("checks", {}) if isinstance(result, dict) else {}
    return "  ".join(f"{name} {value:.0e}" for name, value in checks.items() if math.isfinite(value))


def duration(seconds):
    """`12 s`, `3 min 20 s`, `2 h 05 min`, `5 days`, `40 years`"""
    if not seconds < 365 * 86400:
        return f"{seconds / (365.25 * 86400):.2g} years"
    seconds = round(seconds)
    if seconds < 60:
        return f"{seconds} s"
    if seconds < 3600:
        return f"{seconds // 60} min {seconds % 60:02} s"
    if seconds < 3 * 86400:
        return f"{seconds // 3600} h {seconds % 3600 // 60:02} min"
    return f"{seconds // 86400} days"
