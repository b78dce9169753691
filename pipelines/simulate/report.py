"""Tables of a simulation: statistics over its seeds, and its tensions beside those of the simplified method."""

from __future__ import annotations

import json

import numpy as np

from hakobune.bem import DOFS
from hakobune.mooring.motion.extremes import CONFIDENCE

from ..common.units import KN
from ..printing.verdict import tell
from .file import LEFT_OUT, SUMMARY, first_what_is_left_out, whole_rows
from .file import told as file_told
from .over_runs import differ, notes, overloads, rare_findings, used_in_runs

UNITS = {"m": (1.0, "m"), "rad": (180 / np.pi, "°"), "m/s": (1.0, "m/s"), "N": (1 / KN, "kN")}
COLUMNS = {
    "mean": "mean", "sigma": "σ", "slow": "σ slow", "wave": "σ wave", "T_zero": "T_zero s", "T_peak": "T_pp s",
    "epsilon": "ε", "mean_third": "X 1/3", "mean_tenth": "X 1/10", "smallest": "smallest", "largest": "largest",
}  # fmt: skip
SCALED = {"mean", "sigma", "slow", "wave", "mean_third", "mean_tenth", "smallest", "largest"}
WHOLE = 1e4  # from which numbers are told to the unit, where four digits would take a power of ten
SMALL = 50.0  # m, length of a hull that is none of the report's floaters
FAR, NOTABLE = 2.0, 0.5  # times the spectral σ of slow motion; of the σ of motion with the waves
NOTHING = 1e-5  # of the hull's length, rad: slow motion that is none
LONG, SHALLOW, DEEP = 10.0, 20.0, 40.0  # slowest periods in a run; m, SR179 report (1982), section 5.5.3


def show(console, file, beside, findings):
    """Print the tables of an open file and findings; beside : MultiPoint of the same study, or None.  Exit status."""
    told = int(whole_rows(file).sum())
    hours = float(file.attrs["duration"]) / 3600
    title = f"{told} seed{'s' * (told != 1)} of {hours:.4g} h; amplitudes of maxima from the mean"
    findings = first_what_is_left_out((*file_told(file), *findings))
    first = [line for line in findings if line.startswith(LEFT_OUT)]
    for text in first:
        console.print(text, style="yellow", highlight=False, soft_wrap=True, markup=False)
    console.print(statistics_table(file, title))
    if len(file["line"]):
        console.print(lines_table(file, beside))
    split = f"σ slow and σ wave lie below and above {file.attrs['split_frequency']:.4g} rad/s"
    chosen = [line for line in file_told(file) if line not in first]
    for text in (*notes(file), split, *chosen):
        console.print(text, highlight=False, soft_wrap=True, markup=False)
    warnings = [line for line in findings if line not in (*first, *chosen)]
    return tell([*warnings, *overloads(file)], console)


def statistics_table(file, title):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for i, name in enumerate(("", *COLUMNS.values(), "median extreme", f"{100 * CONFIDENCE:.0f} % interval")):
        table.add_column(name, justify="right" if i else "left", no_wrap=True)
    units = json.loads(file["quantity"].attrs["quantity_units"])
    for name, unit, row in zip(file["quantity"].asstr()[()], units, file["summary"][()], strict=True):
        value = dict(zip(SUMMARY, row, strict=True))
        factor, word = UNITS[unit]
        cells = [_number(value[key] * (factor if key in SCALED else 1.0)) for key in COLUMNS]
        table.add_row(f"{name}, {word}", *cells, *_extreme(value, factor))
    return table


def _extreme(value, factor):
    """Median extreme and its interval, of the end of a motion that lies further from zero"""
    end = "lower" if abs(value["lower_median"]) > abs(value["upper_median"]) else "upper"
    low, high = value[f"{end}_low"] * factor, value[f"{end}_high"] * factor
    interval = f"{_number(low)} to {_number(high)}" if low < high else "–"
    return _number(value[f"{end}_median"] * factor), interval


def lines_table(file, beside):
    """Largest tension of each line in all runs and what it uses of the breaking load, beside the simplified method

    beside : MultiPoint, or None to leave that out
    """
    from rich.table import Table

    title = "largest tension, kN: simulation beside the simplified method" if beside else "largest tension, kN"
    table = Table(title=title, title_justify="left")
    more = ("simplified", "ratio") if beside else ()
    for i, name in enumerate(
        ("line", "mean", "σ", "simulated", *more, "used %", *(["simplified %"] if beside else ()))
    ):
        table.add_column(name, justify="right" if i else "left", no_wrap=True)
    used = used_in_runs(file).max(axis=0)
    for i, line in enumerate(file["line"].asstr()[()]):
        value = line_values(file, line)
        cells = [_number(value[key] / KN) for key in ("mean", "sigma", "largest")]
        if beside:
            cells += [_number(beside.tension[i] / KN), f"{value['largest'] / beside.tension[i]:.2f}"]
        shares = [used[i], *([beside.utilisation[i]] if beside else ())]
        style = "red" if used[i] > file.attrs["allowable"] else None
        table.add_row(line, *cells, *(_share(100 * share) for share in shares), style=style)
    return table


def line_values(file, line):
    """{statistic: N} over all runs of the tension of a line"""
    place = list(file["quantity"].asstr()[()]).index(f"tension {line}")
    return dict(zip(SUMMARY, file["summary"][place], strict=True))


def slow_findings(file, spectral):
    """Findings on slow motion far beyond the linear answer.

    spectral : (3,) m, m, rad, σ of slow surge, sway and yaw on springs as stiff as the lines under the mean loads
    """
    names = list(file["quantity"].asstr()[()])
    hull = float(file.attrs["hull"][0])
    for mode, unit, expected in zip(("surge", "sway", "yaw"), ("m", "m", "rad"), spectral, strict=True):
        length = 1.0 if unit == "rad" else hull
        value = dict(zip(SUMMARY, file["summary"][names.index(mode)], strict=True))
        slow = value["slow"]
        if np.isfinite(expected) and slow > max(FAR * expected, NOTABLE * value["wave"], NOTHING * length):
            factor, word = UNITS[unit]
            yield (
                f"slow {mode} has σ {slow * factor:.3g} {word}, slow forces on springs as stiff as the lines under the "
                f"mean loads give {expected * factor:.3g} {word}: lines that stiffen let waves alone drive it; see "
                'how much with simulation.slow_drift = "none" and without wind and current'
            )


def findings(file, moored_periods, wave_period):
    """What holds of all runs: their length, and which method applies.  moored_periods : {mode: s}; wave_period : s"""
    slow = max((value for value in moored_periods.values() if np.isfinite(value)), default=0.0)
    duration = float(file.attrs["duration"])
    yield from rare_findings(file)
    if duration < LONG * slow and differ(file):
        share = 1 / np.sqrt(max(2 * duration / slow, 1.0))
        yield (
            f"a run of {duration:g} s holds {duration / slow:.2g} of the slowest natural periods ({slow:.3g} s), "
            f"wanted {LONG:g}: its σ is uncertain by about {100 * share:.0f} %; simulate {LONG * slow:.3g} s"
        )
    depth, draft = float(file.attrs["water_depth"]), float(file.attrs["hull"][2])
    if wave_period and moored_periods:
        near = [f"{n.lower()} {v / wave_period:.2g}" for n, v in moored_periods.items() if n in DOFS and np.isfinite(v)]
        named = f"depth over draft {depth / draft:.3g}; natural over wave period: {', '.join(near)}"
        if float(file.attrs["hull"][0]) < SMALL:
            yield f"{named}; the report's limits in metres of water are for floaters of 100 to 200 m, not for this one"
        elif depth <= SHALLOW:
            yield f"{named}; in up to {SHALLOW:g} m of water take the simulation (SR179 report, section 5.5.3)"
        elif depth >= DEEP:
            yield f"{named}; from {DEEP:g} m of water on the simplified method is on the safe side there as well"
        else:
            yield f"{named}; between {SHALLOW:g} and {DEEP:g} m of water take the larger of the two"


def _number(value):
    return "–" if not np.isfinite(value) else f"{value:.0f}" if abs(value) >= WHOLE else f"{value:.4g}"


def _share(value):
    return "unknown" if np.isnan(value) else f"{value:.1f}"
