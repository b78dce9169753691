"""Findings on the runs of a simulation: their length, slow motion, and which method applies."""

import numpy as np

from hakobune.mooring.response.findings import LINES_NAMED, large_rotations, some

from .file import summary_of
from .over_runs import differ, rare_findings

UNITS = {"m": (1.0, "m"), "rad": (180 / np.pi, "°")}
SMALL = 50.0  # m, length of a hull that is none of the report's floaters
FAR, NOTABLE = 2.0, 0.5  # factor on the spectral σ of slow motion; fraction of the σ of motion with the waves
SLACK = 0.01  # of the breaking load: smallest tension below which a rope of fibre counts as slack
NOTHING = 1e-5  # slow motion over the hull length, or rad, that counts as zero
LONG, SHALLOW, DEEP = 10.0, 20.0, 40.0  # slowest periods in a run; m, SR179 report (1982), section 5.5.3
FREE = 1000.0  # s, natural period at a berth from which ropes and fenders do not hold the body
PLANE = ("surge", "sway", "yaw")


def slow_findings(file):
    """Findings on slow motion that is far larger than the linear answer, with springs as stiff as the lines under the
    mean loads"""
    if np.isfinite(file.attrs.get("lost_at", np.inf)):  # the linear answer is that of all lines
        return
    hull, spectral = float(file.attrs["hull"][0]), np.asarray(file.attrs.get("spectral_slow", [np.nan] * 3))
    for mode, unit, expected in zip(PLANE, ("m", "m", "rad"), spectral, strict=True):
        if not np.isfinite(expected):
            continue
        length = 1.0 if unit == "rad" else hull
        value = summary_of(file, mode)
        slow = value["slow"]
        if slow > max(FAR * expected, NOTABLE * value["wave"], NOTHING * length):
            factor, word = UNITS[unit]
            yield (
                f"slow {mode} has σ {slow * factor:.3g} {word}; slow forces on springs as stiff as the lines "
                f"under the mean loads would give {expected * factor:.3g} {word}; first-order waves cause the "
                "rest through the stiffening of the lines; to see the part of these waves alone, run with "
                'simulation.slow_drift = "none" and without wind and current'
            )


def tilt_findings(file):
    """Findings on roll and pitch, from upright, for which the equation of motion is no longer linear"""
    tilts = [name for name in file["quantity"].asstr()[()] if name.split()[-1] in ("roll", "pitch")]
    ends = {name: [abs(summary_of(file, name)[end]) for end in ("smallest", "largest")] for name in tilts}
    yield from large_rotations({name: float(np.degrees(np.max(both))) for name, both in ends.items()})


def slack_findings(file):
    """A finding on lines and ropes without any pull in all runs"""
    pulls = [name for name in file["quantity"].asstr()[()] if name.startswith("tension ")]
    slack = [name.removeprefix("tension ") for name in pulls if summary_of(file, name)["largest"] == 0]
    if slack:
        yield f"lines without tension in all runs: {some(slack, LINES_NAMED)}; check their lengths"


def fibre_findings(file):
    """A finding on lines with ropes of fibre that fall slack"""
    names = [name for name in str(file.attrs.get("fibre_lines", "")).split("\n") if name]
    if not names:
        return
    breaking = dict(zip(file["line"].asstr()[()], np.asarray(file.attrs["breaking_load"], float), strict=True))
    ends = {name: summary_of(file, f"tension {name}") for name in names}
    loose = [
        (one["smallest"], name)
        for name, one in ends.items()
        if one["largest"] > 0 and np.isfinite(breaking[name]) and one["smallest"] < SLACK * breaking[name]
    ]
    if loose:
        told = some([f"{name} {least / 1e3:.3g} kN" for least, name in sorted(loose)], LINES_NAMED)
        yield (
            f"ropes of fibre fall slack: {told}; "
            f"limit of the smallest tension: {100 * SLACK:g} % of the breaking load; a slack rope snaps when it comes "
            "taut, and wears by compression: give more pretension"
        )


def findings(file):
    """Findings that hold for all runs: their length, slow motion, and which method applies"""
    periods = np.asarray(file.attrs.get("moored_period", [np.nan] * 3), float)
    moored_periods = {name: T for name, T in zip(PLANE, periods, strict=True) if not np.isnan(T)}
    wave_period = float(file.attrs["mean_period"])
    at_berth = [T for T in np.ravel(file.attrs.get("natural_period", ())) if T < FREE]
    slow = max((value for value in [*moored_periods.values(), *at_berth] if np.isfinite(value)), default=0.0)
    duration = float(file.attrs["duration"])
    yield from rare_findings(file)
    yield from slow_findings(file)
    yield from tilt_findings(file)
    yield from slack_findings(file)
    yield from fibre_findings(file)
    if duration < LONG * slow and differ(file):
        share = 1 / np.sqrt(max(2 * duration / slow, 1.0))
        yield (
            f"a run of {duration:g} s covers {duration / slow:.2g} of the slowest natural periods ({slow:.3g} s), "
            f"recommended {LONG:g}: σ of this motion is uncertain by about {100 * share:.0f} %; simulate "
            f"{LONG * slow:.3g} s"
        )
    depth, draft = float(file.attrs["water_depth"]), float(file.attrs["hull"][2])
    if np.isfinite(wave_period) and moored_periods:
        near = [f"{n} {v / wave_period:.2g}" for n, v in moored_periods.items() if np.isfinite(v)]
        named = f"depth over draft {depth / draft:.3g}; natural over wave period: {', '.join(near)}"
        if float(file.attrs["hull"][0]) < SMALL:
            yield (
                f"{named}; the SR179 report's limits of water depth are for floaters of 100 to 200 m length, not for "
                f"this floater"
            )
        elif depth <= SHALLOW:
            yield f"{named}; in up to {SHALLOW:g} m of water use the simulation (SR179 report, section 5.5.3)"
        elif depth >= DEEP:
            yield f"{named}; in {DEEP:g} m of water or more, the simplified method is also on the safe side"
        else:
            yield f"{named}; between {SHALLOW:g} and {DEEP:g} m of water use the larger of the two"
