"""Tables of a simulation: statistics over its seeds, and its tensions beside those of the simplified method."""

from __future__ import annotations

import json

import numpy as np

from bem import DOFS
from mooring.motion.statistics import CONFIDENCE

from ..common.units import KN
from .file import SUMMARY, whole_rows

UNITS = {"m": (1.0, "m"), "rad": (180 / np.pi, "°"), "m/s": (1.0, "m/s"), "N": (1 / KN, "kN")}
COLUMNS = {
    "mean": "mean", "sigma": "σ", "slow": "σ slow", "wave": "σ wave", "T_zero": "T_zero s", "T_peak": "T_pp s",
    "epsilon": "ε", "mean_third": "X 1/3", "mean_tenth": "X 1/10", "smallest": "smallest", "largest": "largest",
}  # fmt: skip
SCALED = {"mean", "sigma", "slow", "wave", "mean_third", "mean_tenth", "smallest", "largest"}
UNLIKELY = 1.3  # largest simulated over the expected; the largest of a Gaussian record scatters by a tenth
WHOLE = 1e4  # from which numbers are told to the unit, where four digits would take a power of ten
SMALL = 50.0  # m, length of a hull that is none of the report's floaters
FAR, NOTABLE = 2.0, 0.5  # times the spectral σ of slow motion; of the σ of motion with the waves
LONG, SHALLOW, DEEP = 10.0, 20.0, 40.0  # slowest periods in a run; m, SR179 report (1982), section 5.5.3


def show(console, file, beside, findings):
    """Print the tables of an open file; beside : MultiPoint of the same study, or None"""
    told = int(whole_rows(file).sum())
    hours = float(file.attrs["duration"]) / 3600
    title = f"{told} seed{'s' * (told != 1)} of {hours:.4g} h; amplitudes of maxima from the mean"
    console.print(statistics_table(file, title))
    if beside is not None:
        console.print(lines_table(file, beside))
    else:
        findings = [*findings, *used(file)]
    for text in (*notes(file), *(f"warning: {line}" for line in findings)):
        console.print(text, style="yellow" * text.startswith("warning"), highlight=False, soft_wrap=True, markup=False)


def statistics_table(file, title):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for i, name in enumerate(("", *COLUMNS.values(), "extreme", f"{100 * CONFIDENCE:.0f} % interval")):
        table.add_column(name, justify="right" if i else "left", no_wrap=True)
    units = json.loads(file["quantity"].attrs["quantity_units"])
    for name, unit, row in zip(file["quantity"].asstr()[()], units, file["summary"][()], strict=True):
        value = dict(zip(SUMMARY, row, strict=True))
        factor, word = UNITS[unit]
        cells = [_number(value[key] * (factor if key in SCALED else 1.0)) for key in COLUMNS]
        table.add_row(f"{name}, {word}", *cells, *_extreme(value, factor))
    return table


def _extreme(value, factor):
    """The end of a motion that lies further from zero"""
    upper = not abs(value["lower_value"]) > abs(value["upper_value"])
    end = "upper" if upper else "lower"
    low, high = value[f"{end}_low"] * factor, value[f"{end}_high"] * factor
    interval = f"{_number(low)} to {_number(high)}" if np.isfinite(low) else "–"
    return _number(value[f"{end}_value"] * factor), interval


def lines_table(file, beside):
    """Largest tension of each line by both methods, and what both use of the breaking load"""
    from rich.table import Table

    table = Table(title="largest tension, kN: simulation beside the simplified method", title_justify="left")
    for i, name in enumerate(("line", "mean", "σ", "simulated", "simplified", "ratio", "used %", "simplified %")):
        table.add_column(name, justify="right" if i else "left", no_wrap=True)
    for i, line in enumerate(file["line"].asstr()[()]):
        value = line_values(file, line)
        load, simple, largest = file.attrs["breaking_load"][i], beside.tension[i], largest_tension(value)
        share = 100 * largest / load if np.isfinite(load) else np.nan
        numbers = [value["mean"], value["sigma"], largest, simple]
        cells = [*(_number(n / KN) for n in numbers), f"{largest / simple:.2f}"]
        style = "red" if share > 100 * file.attrs["allowable"] else None
        table.add_row(line, *cells, _share(share), _share(100 * beside.utilisation[i]), style=style)
    return table


def line_values(file, line):
    """{statistic: N} over all runs of the tension of a line"""
    place = list(file["quantity"].asstr()[()]).index(f"tension {line}")
    return dict(zip(SUMMARY, file["summary"][place], strict=True))


def largest_tension(value):
    """N, of `line_values`: the expected extreme, without a distribution at least what was simulated"""
    return value["upper_value"] if value["upper_runs"] else max(value["upper_value"], value["largest"])


def used(file):
    """Findings on lines and ropes beyond what they may carry, where the simplified method does not tell"""
    allowable = float(file.attrs["allowable"])
    for line, load in zip(file["line"].asstr()[()], file.attrs["breaking_load"], strict=True):
        largest = largest_tension(line_values(file, line))
        if largest > allowable * load:
            yield (
                f"{line} pulls up to {largest / KN:.4g} kN, {100 * largest / load:.3g} % of its breaking load; "
                f"allowed: {100 * allowable:g} %"
            )


def slow_findings(file, spectral):
    """Findings on slow motion far beyond the linear answer.

    spectral : (3,) m, m, rad, σ of slow surge, sway and yaw on springs as stiff as the lines under the mean loads
    """
    names = list(file["quantity"].asstr()[()])
    for mode, unit, expected in zip(("surge", "sway", "yaw"), ("m", "m", "rad"), spectral, strict=True):
        value = dict(zip(SUMMARY, file["summary"][names.index(mode)], strict=True))
        slow = value["slow"]
        if np.isfinite(expected) and slow > max(FAR * expected, NOTABLE * value["wave"]):
            factor, word = UNITS[unit]
            yield (
                f"slow {mode} has σ {slow * factor:.3g} {word}, slow forces on springs as stiff as the lines under the "
                f"mean loads give {expected * factor:.3g} {word}: lines that stiffen let waves alone drive it; see "
                'how much with simulation.slow_drift = "none" and without wind and current'
            )


def notes(file):
    """How the columns are to be read"""
    runs = int(np.nanmax(file["summary"][:, SUMMARY.index("upper_runs")]))
    period = float(file.attrs["mean_period"])
    if runs:
        yield f"extreme: mean of Gumbel's distribution fitted to the largest values of {runs} runs, with its interval"
    else:
        of = f"1000 mean wave periods ({1000 * period:.5g} s)" if np.isfinite(period) else "a run"
        yield f"extreme: mean + σ(s + γ/s) of {of}, a formula for Gaussian records; from 5 seeds on Gumbel's is fitted"
    yield f"σ slow and σ wave lie below and above {file.attrs['split_frequency']:.4g} rad/s"


def findings(file, moored_periods, wave_period):
    """What holds of all runs: their length, and which method applies.  moored_periods : {mode: s}; wave_period : s"""
    slow = max((value for value in moored_periods.values() if np.isfinite(value)), default=0.0)
    duration, table = float(file.attrs["duration"]), file["summary"][()]
    tensions = [name.startswith("tension") for name in file["quantity"].asstr()[()]]
    formula = table[~(table[:, SUMMARY.index("upper_runs")] > 0) & np.array(tensions, bool)]
    upper = formula[:, SUMMARY.index("upper_value")]
    beyond = np.max(formula[upper > 0, SUMMARY.index("largest")] / upper[upper > 0], initial=0.0)
    if beyond > UNLIKELY:
        yield (
            f"tensions up to {beyond:.2g} times the extreme of the formula were simulated: they are not Gaussian; "
            "give 5 seeds or more"
        )
    if duration < LONG * slow:
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
