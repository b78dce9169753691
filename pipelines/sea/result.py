"""`hakobune.sea`: a wave spectrum from parameters, a table or a record: moments, periods, heights."""

from __future__ import annotations

import math
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import LARGEST
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.environment.crossings import expected_maximum_height, rayleigh_height
from hakobune.mooring.environment.periods import KINDS, WORDS
from hakobune.mooring.environment.spectrum import Spectrum, Tabulated

from ..common.bounds import check_memory, check_seconds, told, whole_number
from ..results.given import File, Tables, words_of
from ..results.heard import heard
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels, records
from .flags import ReadingFlags, RecordFlags, SpectrumFlags

FEWEST, APART = 50, 25.0  # components of a record; frequencies it resolves for each of them
LONGEST = 10_000_000  # values of a record
# cost of making a record, measured: bytes per component times √values, per value, per component; then s per value and
# per component, s more per component with Mitsuyasu's directions, s per component and value, and per component √values
BYTES = 64, 180, 700
OF_BYTE = 1.5e-7  # s per byte of a record that is read
SECONDS, OF_DIRECTIONS, OF_PHASES, OF_ROOT = (1e-6, 3e-6), 6e-5, 0.5e-9, 8e-8
WAVES = 1000  # number of waves of the expected maximum of a spectrum without a record
ROWS = 1000  # rows of a stored spectrum
SHARES = (1e-6, 1 - 1e-4)  # shares of its energy below the first and the last row
MOMENTS = {  # order: unit, description
    -1: ("m2 s/rad", "m₋₁"), 0: ("m2", "m₀"), 1: ("m2 rad/s", "m₁"), 2: ("m2 rad2/s2", "m₂"), 3: ("m2 rad3/s3", "m₃"),
}  # fmt: skip
COUNTS = ("seed", "components")  # flags that are whole numbers in words


class Findings(NamedTuple):
    """A spectrum; a `Record`, its `ZeroCrossings` and the estimate of its spectrum, each None without a record

    analysed : whether the spectrum is estimated from the record; notes : one line each
    """

    title: str
    spectrum: Spectrum
    record: object = None
    waves: object = None
    estimate: object = None
    analysed: bool = False
    notes: tuple[str, ...] = ()


def sea(
    spectrum: File | Tables | Spectrum,
    *,
    record: Tables | None = None,
    reading: Tables | None = None,
    depth: float | None = None,
) -> Result:
    """Moments, periods and heights of a wave spectrum or of a wave record; on request a record generated from the
    spectrum.

    spectrum : path of a record that is analysed (CSV), a `mooring.environment.spectrum.Spectrum`, or the command's
        flags, such as {"height": 3.0, "mean_period": 8.0}
    record : keys or flags of a generated record, such as {"duration": 3600.0, "seed": 2}; {} for the default. The
        direction is in degrees
    reading : keys or flags for a record that is read from a file: column, segment, and step (s) if it has no times
    depth : water depth, m; None for deep water
    returns : Result, in SI; its `detail` is a Findings
    raises : ValueError, with a message of one line
    """
    with heard() as said:
        if isinstance(spectrum, Spectrum | dict):
            refuse("no record file is given", _flags(ReadingFlags, reading), ReadingFlags())
            words = _flags(RecordFlags, record, depth)
            if isinstance(spectrum, dict):
                text = words_of(**{key: str(one) if isinstance(one, Path) else one for key, one in spectrum.items()})
                spectrum = _spectrum(_flags(SpectrumFlags, spectrum), depth)
            else:
                text = spectrum.name
            found = _made(spectrum, None if record is None else words, depth)
        else:
            refuse("a record file is given", _flags(RecordFlags, record, depth), RecordFlags())
            step, rest = (reading or {}).get("step"), {k: v for k, v in (reading or {}).items() if k != "step"}
            text, found = str(spectrum), _analysed(Path(spectrum), step, _flags(ReadingFlags, rest))
    return result_of(found, tuple(said), text)


def _flags(kind, given, depth=None):
    """Flags of a kind by their names.  Raises ValueError for an unknown name."""
    known = [name for name in kind.__dataclass_fields__ if name not in ("record", "depth")]
    wrong = [name for name in given or {} if name not in known]
    if wrong:
        raise ValueError(f"sea has no {wrong[0]!r}; allowed: {', '.join(known)}")
    words = {name: str(one) if name in COUNTS and one is not None else one for name, one in (given or {}).items()}
    return kind(**words, **({} if depth is None else {"depth": depth}))


def _analysed(file, step, reading):
    from hakobune.mooring.environment.crossings import zero_crossings
    from hakobune.mooring.environment.spectrum_estimate import estimate
    from hakobune.mooring.environment.wave_records import read_record
    from hakobune.mooring.seas.record_faults import faults

    size = file.stat().st_size if file.is_file() else 0
    if size <= LARGEST * 1e6:  # the reader reports other faults of the file
        told(f"{file} of {size / 1e6:.0f} MB takes", OF_BYTE * size)
    read = read_record(file, step, reading.column)
    estimated = estimate(read.elevation, read.step, reading.segment)
    waves = zero_crossings(read.elevation, read.step)
    for line in faults(read.elevation, read.step, waves.mean_period):
        warnings.warn(fails(line), stacklevel=2)
    title = f"{file}: {len(read.elevation)} values at {read.step:g} s, {len(waves)} waves"
    return Findings(title, estimated.spectrum(file.stem), read, waves, estimated, analysed=True)


def _made(spectrum, words, depth):
    """words : RecordFlags of a record, None for none"""
    if depth is not None and math.isfinite(depth):
        from hakobune.mooring.seas.breaking import too_high

        for line in too_high(spectrum, depth):
            warnings.warn(line, stacklevel=2)
    title = f"{spectrum.name} spectrum"
    if words is None:
        return Findings(title, spectrum)
    from hakobune.mooring.environment.crossings import zero_crossings
    from hakobune.mooring.environment.spectrum_estimate import estimate

    made = _record(spectrum, words)
    waves = zero_crossings(made.elevation, made.step)
    title += f", record of {len(made.elevation)} values at {made.step:g} s, {len(waves)} waves"
    return Findings(title, spectrum, made, waves, estimate(made.elevation, made.step), notes=_of_band(spectrum))


def _of_band(spectrum):
    """Share of T02 in the components of a record: a tail ω⁻⁵ gives part of it to waves with hardly any energy"""
    from hakobune.mooring.environment.sea import BAND

    low, high = spectrum.quantile(BAND)
    held = 2 * math.pi * math.sqrt(spectrum.moment(0, low, high) / spectrum.moment(2, low, high))
    return (
        f"the record has waves of {low:.3g} to {high:.3g} rad/s; their T02 is {held:.4g} s, "
        f"{100 * (held / spectrum.T02 - 1):.3g} % longer than T02 of the whole spectrum",
    )


def refuse(state, flags, quiet):
    """Raise ValueError for a flag that would have no effect."""
    for name, value in vars(flags).items():
        if value != getattr(quiet, name):
            raise ValueError(f"--{name.replace('_', '-')} has no effect, {state}; leave it out")


def _spectrum(flags, depth):
    from hakobune.mooring.seas.families import PEAKED, families
    from hakobune.mooring.seas.spectra_files import read_sea

    if flags.table is not None:
        refuse("--table is given", flags, SpectrumFlags(table=flags.table, time=flags.time))
        return read_sea(flags.table, x_axis=0.0, time=flags.time).spectrum
    if flags.time is not None:
        raise ValueError("--time is given without --table; give it only with a table of several spectra")
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
            "no sea is given; give --height and a period, --wind-speed and --fetch, --table, or a record file"
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
    refuse("--wind-speed and --fetch are given", flags, known)
    if flags.spectrum == "tma":
        from hakobune.mooring.seas.shallow import tma_fetch

        if depth is None or not math.isfinite(depth):
            raise ValueError("--spectrum tma needs a finite --depth, m")
        return tma_fetch(flags.wind_speed, flags.fetch, depth, **gamma)
    return jonswap_fetch(flags.wind_speed, flags.fetch, **gamma)


def _record(spectrum, flags):
    """Record of one realisation"""
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
    """Random amplitudes need components as close as the record resolves; else a few of them determine its energy."""
    resolved = math.ceil(spectrum.quantile(0.999) * duration / (2 * math.pi))
    return max(500, resolved) if flags.amplitudes == "random" else 500


def _check_effort(components, count, spreading):
    """Raise TooMuchError for a record that is too large, and report the time of a long one."""
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
    """resolved : frequencies that a record of its length can separate"""
    least = max(FEWEST, math.ceil(resolved / APART))
    if components < least:
        warnings.warn(
            f"{components} components are too few for a record that resolves {resolved:.0f} frequencies: the "
            "record is not Gaussian, and its groups and extremes differ from those of the sea; give --components "
            f"{least} or more, or a shorter --duration",
            stacklevel=2,
        )


def _warn_of_long_steps(spectrum, step):
    beyond = 1 - spectrum.moment(0, 0.0, np.pi / step) / spectrum.moment(0)
    if beyond > 0.01:
        warnings.warn(
            fails(
                f"the step of {step:g} s is longer than half the period of waves with {100 * beyond:.1f} % of the "
                "energy; allowed: 1 %; give a shorter --step"
            ),
            stacklevel=2,
        )


def _positive(name, value, otherwise):
    value = otherwise if value is None else value
    if not 0 < value < float("inf"):
        raise ValueError(f"--{name} is {value:g}; allowed: above 0, finite")
    return value


def _point(given):
    try:
        x, y = map(float, (given or "0,0").split(",") if isinstance(given, str | None) else given)
    except ValueError:
        raise ValueError(f"--point is {given!r}; allowed: two numbers x,y") from None
    return x, y


def curve(spectrum):
    """omega (n,) rad/s and density (n,) m² s/rad of a spectrum, for a picture"""
    if isinstance(spectrum, Tabulated):
        return spectrum.omega, spectrum.values
    low, high = spectrum.quantile(SHARES)
    omega = np.geomspace(low, high, ROWS)
    return omega, spectrum.density(omega)


def result_of(found, said, given):
    """Result of Findings; said : warnings; given : origin of the spectrum"""
    spectrum, waves = found.spectrum, found.waves
    heights = _heights(found)
    omega, density = curve(spectrum)
    axes = labels("kind", [WORDS[symbol] for symbol in KINDS.values()]) | labels("of", list(heights))
    axes |= labels("omega", omega, "rad/s")
    m = {order: _moment(spectrum, order) for order in MOMENTS}
    made = quantities("moments", {f"m{order}": (m[order], *MOMENTS[order]) for order in MOMENTS} | {
        "width": (math.sqrt(m[0] * m[2] / m[1] ** 2 - 1), "", "width √(m₀m₂/m₁² − 1)"),
    })  # fmt: skip
    own = {"period": [_known(getattr(spectrum, symbol)) for symbol in KINDS.values()],
           "height": [one for one, _ in heights.values()]}  # fmt: skip
    counted = {}
    if waves is not None:
        periods = {"T02": waves.mean_period, "T_significant": waves.significant_period}
        counted = {"period": [_known(periods.get(symbol)) for symbol in KINDS.values()],
                   "height": [one for _, one in heights.values()]}  # fmt: skip
    for name, axis, unit in (("period", "kind", "s"), ("height", "of", "m")):
        both = {f"{name}.spectrum": (own[name], unit, "of the spectrum")}
        if counted:
            both[f"{name}.record"] = counted[name], unit, "of the record"
        made |= quantities(f"{name}s", both, axis)
    kept = {"spectrum.density": (density, ("omega",), "m2 s/rad", "density of the spectrum")}
    if found.record is not None:
        axes |= labels("time", found.record.time, "s")
        kept["record.elevation"] = found.record.elevation, ("time",), "m", "elevation"
    if found.estimate is not None:
        axes |= labels("band", found.estimate.omega, "rad/s")
        low, high = found.estimate.confidence(0.95)
        for name, values, words in (("", found.estimate.density, "estimate of the record's spectrum"),
                                    (".low", low, "lower end of its 95 % confidence"),
                                    (".high", high, "upper end of its 95 % confidence")):  # fmt: skip
            kept[f"estimate{name or '.density'}"] = values, ("band",), "m2 s/rad", words
    return Result("sea", made | records(kept), axes, said, (found.title, *found.notes),
                  provenance=provenance(given), detail=found)  # fmt: skip


def _moment(spectrum, order):
    """nan if a tail ω⁻⁴ makes it infinite"""
    try:
        return spectrum.moment(order)
    except ValueError:
        return math.nan


def _known(value):
    return math.nan if value is None else float(value)


def _heights(found):
    """{name: (of the spectrum, of the record or nan) m}"""
    m0, waves = found.spectrum.moment(0), found.waves
    count = WAVES if waves is None else len(waves)
    rows = {"4√m₀": (4 * math.sqrt(m0), waves and 4 * found.record.elevation.std())}
    for name, share, part in (("mean", 1.0, "mean"), ("H1/3", 1 / 3, "significant"), ("H1/10", 1 / 10, "tenth")):
        rows[name] = rayleigh_height(m0, share), waves and getattr(waves, f"{part}_height")
    if count >= 10:
        rows[f"highest of {count}"] = expected_maximum_height(m0, count), waves and waves.maximum_height
    return {name: (_known(one), _known(other)) for name, (one, other) in rows.items()}
