"""Lines that tell how far a run is."""

from __future__ import annotations

import math
import time


class Progress:
    """Prints one line per frequency, with the time left estimated from the ones before."""

    def __init__(self, console, total):
        self.console, self.total, self.done, self.started = console, total, 0, time.perf_counter()

    def step(self, where, result, reason):
        """where : ω in rad/s, or the name of a limit; result : of the solver; reason : of a failure, or empty"""
        self.done += 1
        left = (time.perf_counter() - self.started) / self.done * (self.total - self.done)
        place = where if isinstance(where, str) else f"ω {where:7.4f} rad/s  T {2 * math.pi / where:7.2f} s"
        took, rest = (" failed", reason) if reason else (_seconds(result), checks_text(result))
        line = (
            f"{self.done:{len(str(self.total))}}/{self.total}  {place:30}  {took:>9}  {duration(left):>8} left  {rest}"
        )
        self.console.print(line.rstrip(), highlight=False, markup=False, soft_wrap=True)


def _seconds(result):
    return f"{sum(result['wall_time'].values()):.2f} s" if isinstance(result, dict) and "wall_time" in result else ""


def checks_text(result):
    """`reciprocity 2e-04  energy 1e-03` of a result's checks that apply."""
    checks = result.get("checks", {}) if isinstance(result, dict) else {}
    return "  ".join(f"{name} {value:.0e}" for name, value in checks.items() if math.isfinite(value))


def duration(seconds):
    """`12 s`, `3 min 20 s`, `2 h 05 min`"""
    seconds = round(seconds)
    if seconds < 60:
        return f"{seconds} s"
    if seconds < 3600:
        return f"{seconds // 60} min {seconds % 60:02} s"
    return f"{seconds // 3600} h {seconds % 3600 // 60:02} min"
