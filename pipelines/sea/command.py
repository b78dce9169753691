"""`hakobune sea`: a wave spectrum from parameters, a table or a record → moments, periods, heights, picture, record."""

from __future__ import annotations

import math
import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from hakobune.meshing.text_files import LARGEST
from hakobune.mooring.criteria.failing import fails

from ..common.bounds import check_memory, check_seconds, told, whole_number
from ..results.heard import heard
from .flags import ReadingFlags, RecordFlags, SpectrumFlags

FEWEST, APART = 50, 25.0  # components of a record; frequencies it resolves for each of them
LONGEST = 10_000_000  # values of a record
# measured: bytes for a component times √values, for a value, for a component; s for each, and for a component's wave
# of Mitsuyasu's directions; s for a component at a value, and times √values
BYTES = 64, 180, 700
OF_BYTE = 1.5e-7  # s, of a record that is read
SECONDS, OF_DIRECTIONS, OF_PHASES, OF_ROOT = (1e-6, 3e-6), 6e-5, 0.5e-9, 8e-8


@dataclass(frozen=True)
class Findings:
    """Results on a sea: its spectrum; a record, its waves and the estimate of its spectrum.

    analysed : the spectrum is that estimate; notes : one line each
    """

    title: str
    spectrum: object
    record: object = None
    waves: object = None
    estimate: object = None
    analysed: bool = False
    notes: tuple[str, ...] = ()


def sea(
    file: Annotated[Path | None, Parameter(help="record of waves (CSV: time_s,elevation_m) to be analysed")] = None,
    /,
    *,
    spectrum: SpectrumFlags = SpectrumFlags(),  # noqa: B008 - a frozen value
    record: RecordFlags = RecordFlags(),  # noqa: B008
    reading: ReadingFlags = ReadingFlags(),  # noqa: B008
    output: Annotated[Path | None, Parameter(help="write the spectrum to this CSV file")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Moments, periods and heights of a wave spectrum, or of a record of waves; records made of a spectrum.

    Heights in m, periods in s.  hakobune sea --height 3 --mean-period 8 --record waves.csv
    """
    from .report import show, write_spectrum

    _check_places(file, spectrum.table, record.record, output, plot)
    with heard() as caught:
        found = _analysed(file, spectrum, record, reading) if file else _made(spectrum, record, reading)
    if record.record is not None:
        _write(found, record)
    if output is not None:
        write_spectrum(output, found)
    if plot is not None:
        from .plot import draw

        draw(found, plot)
    return show(found, caught, [path for path in (record.record, output, plot) if path])


def _check_places(file, table, record, output, plot):
    from ..common.outputs import check_output
    from ..common.picture import PLOTS, check_picture
    from .report import is_record, is_spectrum

    paths = [Path(os.path.realpath(path)) for path in (file, table, record, output, plot) if path is not None]
    for i, path in enumerate(paths):
        if path in paths[:i]:
            raise ValueError(f"{path.name} is named twice; give each file a name of its own")
    if record is not None:
        check_output(record, "a record made here", is_record, (".csv",))
    if output is not None:
        check_output(output, "a spectrum written here", is_spectrum, (".csv",))
    if plot is not None:
        check_picture(plot, PLOTS)


def _analysed(file, spectrum, record, reading):
    from hakobune.mooring.environment.crossings import zero_crossings
    from hakobune.mooring.environment.spectrum_estimate import estimate
    from hakobune.mooring.environment.wave_records import read_record
    from hakobune.mooring.seas.record_faults import faults

    _refuse("a record file is given", spectrum, SpectrumFlags())
    _refuse("a record file is given", record, RecordFlags(step=record.step))
    size = file.stat().st_size if file.is_file() else 0
    if size <= LARGEST * 1e6:  # what is wrong with it otherwise, the reader says
        told(f"{file} of {size / 1e6:.0f} MB takes", OF_BYTE * size)
    read = read_record(file, record.step, reading.column)
    estimated = estimate(read.elevation, read.step, reading.segment)
    waves = zero_crossings(read.elevation, read.step)
    for line in faults(read.elevation, read.step, waves.mean_period):
        warnings.warn(fails(line), stacklevel=2)
    title = f"{file}: {len(read.elevation)} values at {read.step:g} s, {len(waves)} waves"
    return Findings(title, estimated.spectrum(file.stem), read, waves, estimated, analysed=True)


def _made(flags, record, reading):
    _refuse("no record file is given", reading, ReadingFlags())
    spectrum = _spectrum(flags, record.depth)
    if record.depth is not None and math.isfinite(record.depth):
        from hakobune.mooring.seas.breaking import too_high

        for line in too_high(spectrum, record.depth):
            warnings.warn(line, stacklevel=2)
    title = f"{spectrum.name} spectrum"
    if record.record is None:
        _refuse("no --record is given", record, RecordFlags(depth=record.depth))
        return Findings(title, spectrum)
    from hakobune.mooring.environment.crossings import zero_crossings
    from hakobune.mooring.environment.spectrum_estimate import estimate

    made = _record(spectrum, record)
    waves = zero_crossings(made.elevation, made.step)
    title += f", record of {len(made.elevation)} values at {made.step:g} s, {len(waves)} waves"
    return Findings(title, spectrum, made, waves, estimate(made.elevation, made.step), notes=_of_band(spectrum))


def _of_band(spectrum):
    """What the components of a record leave of T02, which a tail ω⁻⁵ gives to waves that have hardly any energy"""
    from hakobune.mooring.environment.sea import BAND

    low, high = spectrum.quantile(BAND)
    held = 2 * math.pi * math.sqrt(spectrum.moment(0, low, high) / spectrum.moment(2, low, high))
    return (
        f"the record holds waves of {low:.3g} to {high:.3g} rad/s; their T02 is {held:.4g} s, "
        f"{100 * (held / spectrum.T02 - 1):.2g} % longer than that of the whole spectrum",
    )


def _refuse(state, flags, quiet):
    """Raise ValueError for a flag that would have no effect."""
    for name, value in vars(flags).items():
        if value != getattr(quiet, name):
            raise ValueError(f"--{name.replace('_', '-')} has no effect, {state}; leave it out")


def _spectrum(flags, depth):
    from hakobune.mooring.environment import spectra
    from hakobune.mooring.seas.families import PEAKED, families

    if flags.table is not None:
        _refuse("--table is given", flags, SpectrumFlags(table=flags.table))
        return spectra.read_spectrum(flags.table)
    known = families(depth)
    if flags.spectrum not in known:
        raise ValueError(f"--spectrum is {flags.spectrum!r}; allowed: {', '.join(known)}")
    if flags.gamma is not None and flags.spectrum not in PEAKED and flags.wind_speed is None:
        raise ValueError(f"--gamma is given for {flags.spectrum}; allowed: with --spectrum {' or '.join(PEAKED)}")
    gamma = {} if flags.gamma is None else {"gamma": flags.gamma}
    if flags.wind_speed is not None or flags.fetch is not None:
        return _by_fetch(flags, gamma, depth)
    if flags.height is None:
        raise ValueError(
            "nothing says what sea; give --height and a period, --wind-speed and --fetch, --table, or a record file"
        )
    return known[flags.spectrum](flags.height, **gamma, **flags.periods)


def _by_fetch(flags, gamma, depth):
    from hakobune.mooring.environment.spectra import jonswap_fetch

    if flags.wind_speed is None or flags.fetch is None:
        missing = "--wind-speed" if flags.wind_speed is None else "--fetch"
        raise ValueError(f"{missing} is missing; a sea by fetch needs --wind-speed and --fetch")
    known = SpectrumFlags(
        wind_speed=flags.wind_speed,
        fetch=flags.fetch,
        gamma=flags.gamma,
        spectrum=flags.spectrum if flags.spectrum in ("jonswap", "tma") else "issc",
    )
    _refuse("--wind-speed and --fetch are given", flags, known)
    if flags.spectrum == "tma":
        from hakobune.mooring.seas.shallow import tma_fetch

        if depth is None or not math.isfinite(depth):
            raise ValueError("--spectrum tma needs a finite --depth, m")
        return tma_fetch(flags.wind_speed, flags.fetch, depth, **gamma)
    return jonswap_fetch(flags.wind_speed, flags.fetch, **gamma)


def _record(spectrum, flags):
    """Record of one realisation"""
    import numpy as np

    from hakobune.mooring.environment.sea import Sea
    from hakobune.mooring.environment.wave_records import Record, elevation

    from ..common.weather.seas import spreading

    step, duration = _positive("step", flags.step, 0.5), _positive("duration", flags.duration, 3600.0)
    count = round(duration / step)
    if not 16 <= count <= LONGEST:
        raise ValueError(f"--duration {duration:g} s is {count} steps of {step:g} s; allowed: 16 to {LONGEST}")
    _warn_of_long_steps(spectrum, step)
    state = Sea(spectrum, math.radians(flags.direction or 0.0), spreading(flags.spreading, spectrum))
    words = {"frequencies": flags.frequencies, "amplitudes": flags.amplitudes}
    seed = whole_number("seed", flags.seed, 0, 1)
    number = whole_number("components", flags.components, 1, _number_of_components(spectrum, flags, duration))
    _check_effort(number, count, state.spreading)
    _warn_of_few(number, spectrum.quantile(0.999) * duration / (2 * math.pi))
    components = state.components(number, seed, **{key: word for key, word in words.items() if word is not None})
    depth = math.inf if flags.depth is None else flags.depth
    return Record(elevation(components, step * np.arange(count), *_point(flags.point), depth), step)


def _number_of_components(spectrum, flags, duration):
    """Random amplitudes need components as close as the record resolves, else its energy is that of a few of them."""
    resolved = math.ceil(spectrum.quantile(0.999) * duration / (2 * math.pi))
    return max(500, resolved) if flags.amplitudes == "random" else 500


def _check_effort(components, count, spreading):
    """Raise TooMuchError for a record that does not fit, and say what a long one takes."""
    way_out = "give fewer with --components, or a shorter --duration"
    sizes = components * count**0.5, count, components
    what = f"{components} components at {count} times"
    check_memory(f"{what} need", sum(a * b for a, b in zip(BYTES, sizes, strict=True)), way_out)
    directions = OF_DIRECTIONS if spreading is not None and spreading.depends_on_frequency else 0.0
    phases = components * (OF_PHASES * count + OF_ROOT * count**0.5)
    seconds = SECONDS[0] * count + (SECONDS[1] + directions) * components + phases
    check_seconds(f"{what} take", seconds, way_out)
    told(f"{what} take", seconds)


def _warn_of_few(components, resolved):
    """resolved : frequencies that a record of its length tells apart"""
    least = max(FEWEST, math.ceil(resolved / APART))
    if components < least:
        warnings.warn(
            f"{components} components for a record that tells {resolved:.0f} frequencies apart: it is not Gaussian, "
            f"groups and extremes are not those of the sea; give --components {least} or more, or a shorter --duration",
            stacklevel=2,
        )


def _warn_of_long_steps(spectrum, step):
    import numpy as np

    beyond = 1 - spectrum.moment(0, 0.0, np.pi / step) / spectrum.moment(0)
    if beyond > 0.01:
        warnings.warn(
            fails(
                f"step {step:g} s is longer than half the period of {100 * beyond:.1f} % of the energy; "
                "allowed: 1 %; give a shorter --step"
            ),
            stacklevel=2,
        )


def _positive(name, value, otherwise):
    value = otherwise if value is None else value
    if not 0 < value < float("inf"):
        raise ValueError(f"--{name} is {value:g}; allowed: above 0, finite")
    return value


def _point(text):
    try:
        x, y = map(float, (text or "0,0").split(","))
    except ValueError:
        raise ValueError(f"--point is {text!r}; allowed: two numbers x,y") from None
    return x, y


def _write(found, flags):
    from hakobune.mooring.environment.wave_records import write_record

    spectrum = found.spectrum
    comment = f"{spectrum.name} spectrum, 4 sqrt(m0) {spectrum.significant_height:.6g} m, Tp {spectrum.Tp:.6g} s"
    given = [f"{name} {value}" for name, value in vars(flags).items() if value is not None and name != "record"]
    write_record(flags.record, found.record, "\n".join([comment, *given]))
