"""Tables of a sea on the terminal, and its spectrum as CSV."""

from __future__ import annotations

import numpy as np

from hakobune.meshing.seals import write_sealed
from hakobune.mooring.environment.crossings import expected_maximum_height, rayleigh_height
from hakobune.mooring.environment.periods import KINDS, WORDS
from hakobune.mooring.environment.spectrum import Tabulated

from ..common.outputs import opening
from ..printing.verdict import tell

WAVES = 1000  # whose expected maximum is printed for a spectrum without a record
ROWS = 1000  # of a spectrum that is written
SHARES = (1e-6, 1 - 1e-4)  # of its energy that lie below the first and the last row


def show(found, warned, written):
    """Print Findings, warnings, what fails and the names of the files written; returns the exit status."""
    from ..printing.console import new_console

    console = new_console()
    console.print(found.title, highlight=False, soft_wrap=True)
    for line in _tables(found):
        console.print(line)
    for line in found.notes:
        console.print(line, highlight=False, soft_wrap=True)
    status = tell(warned, console)
    if written:
        console.print(f"written: {', '.join(map(str, written))}", highlight=False, soft_wrap=True)
    return status


def write_spectrum(path, found):
    """Write the spectrum, with its 95 % confidence band where it is an estimate, as CSV that --table reads."""
    spectrum = found.spectrum
    comment = f"# {found.title}; 4 sqrt(m0) {spectrum.significant_height:.6g} m, Tp {spectrum.Tp:.6g} s\n"
    names, columns = "omega_rad_s,density_m2_s_rad", list(curve(spectrum))
    if found.analysed:
        comment += f"# 95 % confidence band, {found.estimate.degrees_of_freedom:.4g} degrees of freedom\n"
        names += ",low_m2_s_rad,high_m2_s_rad"
        columns += found.estimate.confidence(0.95)
    rows = [",".join(f"{value:.8g}" for value in row) for row in zip(*columns, strict=True)]
    write_sealed(path, comment + "\n".join([names, *rows]) + "\n")


def is_spectrum(path):
    """Whether a file was made by `write_spectrum`; the user's own table for --table was not"""
    first, names = opening(path)
    return "; 4 sqrt(m0) " in first and names.startswith("omega_rad_s,density_m2_s_rad")


def is_record(path):
    """Whether a file is a record that was made of a spectrum, and no measured one"""
    first, names = opening(path)
    return " spectrum, 4 sqrt(m0) " in first and names == "time_s,elevation_m"


def curve(spectrum):
    """omega (n,) rad/s and density (n,) m² s/rad that draw a spectrum"""
    if isinstance(spectrum, Tabulated):
        return spectrum.omega, spectrum.values
    omega = np.geomspace(*spectrum.quantile(SHARES), ROWS)
    return omega, spectrum.density(omega)


def _tables(found):
    columns = ["of the spectrum"] + ["of the record"] * (found.waves is not None)
    yield _table("moments", columns[:1], _moments(found.spectrum))
    yield _table("periods", columns, _periods(found.spectrum, found.waves))
    yield _table("heights", columns, _heights(found))


def _table(title, columns, rows):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for i, column in enumerate(["", *columns]):
        table.add_column(column, justify="right" if i else "left")
    for label, *values in rows:
        table.add_row(label, *("–" if value is None else f"{value:.5g}" for value in values[: len(columns)]))
    return table


def _moment(spectrum, order):
    """None where a tail ω⁻⁴ gives it no end"""
    try:
        return spectrum.moment(order)
    except ValueError:
        return None


def _moments(spectrum):
    m = {n: _moment(spectrum, n) for n in (-1, 0, 1, 2, 3)}
    names = ("m₋₁, m² s/rad", "m₀, m²", "m₁, m² rad/s", "m₂, m² (rad/s)²", "m₃, m² (rad/s)³")
    yield from zip(names, m.values(), strict=True)
    yield "width √(m₀m₂/m₁² − 1)", np.sqrt(m[0] * m[2] / m[1] ** 2 - 1)


def _periods(spectrum, waves):
    counted = {} if waves is None else {"T02": waves.mean_period, "T_significant": waves.significant_period}
    for symbol in KINDS.values():
        yield f"{WORDS[symbol]}, s", getattr(spectrum, symbol), counted.get(symbol)


def _heights(found):
    m0, waves = found.spectrum.moment(0), found.waves
    count = WAVES if waves is None else len(waves)
    yield "4√m₀, m", 4 * np.sqrt(m0), waves and 4 * found.record.elevation.std()
    yield "mean, m; of a spectrum by Rayleigh", rayleigh_height(m0, 1.0), waves and waves.mean_height
    yield "H1/3, m; by Rayleigh", rayleigh_height(m0, 1 / 3), waves and waves.significant_height
    yield "H1/10, m; by Rayleigh", rayleigh_height(m0, 1 / 10), waves and waves.tenth_height
    if count >= 10:
        yield f"highest of {count}, m", expected_maximum_height(m0, count), waves and waves.maximum_height
