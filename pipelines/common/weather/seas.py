"""Seas in the words of studies and flags: families of spectra, their shape, spreading over directions."""

import math
from pathlib import Path

import msgspec

from ..quantities import StudyError, Table, direction, positive
from . import SPREADINGS

PERIODS = ("period", "mean_period", "zero_crossing_period", "energy_period", "peak_period", "significant_period")


class SpectrumTable(Table):
    """A sea with a significant height and one period: mean, zero-crossing, energy, peak or significant

    height : m, significant wave height
    period : s, mean period, as mean_period
    """

    height: float | None = None
    period: float | None = None
    mean_period: float | None = None
    zero_crossing_period: float | None = None
    energy_period: float | None = None
    peak_period: float | None = None
    significant_period: float | None = None
    spectrum: str = "issc"
    gamma: float | None = None
    spreading: str | None = None


class SeaTable(SpectrumTable):
    """A sea of one wave system, such as swell, from a height and one period or from a spectrum file

    file : file of a spectrum (SWAN, NDBC, WAVEWATCH III, CSV) beside the study, in place of height and period
    x_axis_compass_deg : compass heading of the x axis, for nautical directions of a file
    time : time of the spectrum, needed for a file with several times
    location : number of the place, counted from 1, needed for a file with several places
    """

    direction_deg: float | None = None
    incidence_deg: float | None = None
    file: str | None = None
    x_axis_compass_deg: float | None = None
    time: str | None = None
    location: int = 1

    def sea(self, where, depth):
        """The Sea in water of `depth` m, of a file as `files_at` found it.  Raises ValueError."""
        if (self.height is None) == (self.file is None):
            state = "neither is given" if self.height is None else "both are given"
            raise StudyError(f"{where}: {state}; give one of height, file")
        if self.file is None:
            return sea_of(where, self, direction(where, self), depth)
        given = [key for key in (*PERIODS, "gamma") if getattr(self, key) is not None]
        if given:
            raise StudyError(f"{where}.{given[0]} is given together with a file that contains it; leave the key out")
        return _of_file(where, self)


class SystemsTable(SeaTable):
    """A sea of one wave system or several

    swell : further wave systems, each with its own direction
    """

    swell: list[SeaTable] = msgspec.field(default_factory=list)


class WavesTable(SystemsTable):
    """An irregular sea, or a regular wave

    method : "irregular", waves of a spectrum, or "regular_wave", a regular wave of this height and mean period as in
        the SR179 report
    duration_hours : duration of the sea whose largest motions are computed
    motion_factor : factor on the motions from which line tensions are computed, 1.5 in some rules
    """

    method: str = "irregular"
    duration_hours: float = 3.0
    motion_factor: float = 1.0


def period_of(where, table):
    """{kind: s} of the one period of a SpectrumTable, "period" as mean_period.  Raises StudyError."""
    given = {kind: getattr(table, kind) for kind in PERIODS if getattr(table, kind) is not None}
    if len(given) != 1:
        state = " and ".join(given) + " are given" if given else "no period is given"
        raise StudyError(f"{where}: {state}; allowed: one of {', '.join(PERIODS)}")
    ((kind, value),) = given.items()
    return {"mean_period" if kind == "period" else kind: positive(f"{where}.{kind}", value)}


def spectrum_of(where, table, depth):
    """The Spectrum of a SpectrumTable in `depth` m.  Raises StudyError."""
    if table.height is None:
        raise StudyError(f"{where}.height is missing; give the significant height, m")
    height, period = positive(f"{where}.height", table.height), period_of(where, table)
    try:
        return family_of(where, table, depth)(height, **period, **shape_of(table))
    except StudyError:
        raise
    except ValueError as error:
        raise StudyError(f"{where}: {error}") from None


def mean_wave(waves, spectrum):
    """Height, m, and mean period, s, of a WavesTable: as given, otherwise those of its spectrum, including swell"""
    given = waves.period if waves.mean_period is None else waves.mean_period
    if waves.swell or waves.file is not None:
        return float(spectrum.significant_height), float(spectrum.T01)
    return waves.height, float(spectrum.T01) if given is None else given


def mean_period(where, table, depth):
    """Mean period, s, of a SpectrumTable or SeaTable in `depth` m: as given, otherwise that of its spectrum.  Raises
    StudyError.
    """
    if getattr(table, "file", None) is not None:
        return float(table.sea(where, depth).spectrum.T01)
    period = period_of(where, table)
    return period["mean_period"] if "mean_period" in period else float(spectrum_of(where, table, depth).T01)


def sea_with_swell(where, waves, depth):
    """The Sea of a SystemsTable, or Systems including its swell, in `depth` m.  Raises StudyError."""
    from hakobune.mooring.seas.systems import Systems

    own = waves.sea(where, depth)
    more = [one.sea(f"{where}.swell[{i}]", depth) for i, one in enumerate(waves.swell)]
    return Systems((own, *more)) if more else own


def files_at(table, folder):
    """A raw table of a sea, with the `folder` added to the paths of its files and of the files of its swell"""
    found = dict(table)
    if isinstance(table.get("file"), str):
        found["file"] = str(folder / table["file"])
    if isinstance(table.get("swell"), list):
        found["swell"] = [files_at(one, folder) if isinstance(one, dict) else one for one in table["swell"]]
    return found


def seas_at(raw, folder):
    """Nested dictionaries of a study with its seas changed by `files_at`, and the paths of their files"""
    changed, files = dict(raw), []
    for key in ("waves", "sea"):
        if isinstance(raw.get(key), dict):
            changed[key] = files_at(raw[key], folder)
            files += files_of(changed[key])
    simulation = raw.get("simulation")
    if isinstance(simulation, dict) and isinstance(simulation.get("sea"), list):
        more = [files_at(one, folder) if isinstance(one, dict) else one for one in simulation["sea"]]
        changed["simulation"] = {**simulation, "sea": more}
        files += [file for one in more if isinstance(one, dict) for file in files_of(one)]
    return (changed, files) if files else (raw, [])


def files_of(table):
    """Paths of the files of a raw table of a sea, from `files_at`"""
    systems = (table, *(table["swell"] if isinstance(table.get("swell"), list) else ()))
    return [Path(one["file"]) for one in systems if isinstance(one, dict) and isinstance(one.get("file"), str)]


def _of_file(where, table):
    """The Sea of a file of `spectra_files`; a direction and a spreading in the study replace those of the file"""
    from hakobune.mooring.environment.sea import Sea
    from hakobune.mooring.seas.spectra_files import TabulatedSpreading, read_sea

    path = Path(table.file)
    sea = read_sea(path, table.x_axis_compass_deg, table.time, table.location)
    given = table.direction_deg is not None or table.incidence_deg is not None
    if isinstance(sea.spreading, TabulatedSpreading) and (given or table.spreading is not None):
        raise StudyError(f"{where}: {path.name} contains directions; leave out direction and spreading")
    if isinstance(sea.spreading, TabulatedSpreading):
        return sea
    towards = direction(where, table) if given or sea.spreading is None else sea.direction
    spread = spreading_of(where, table, sea.spectrum) if table.spreading is not None else sea.spreading
    return Sea(sea.spectrum, towards, spread)


def family_of(where, table, depth):
    """Function of `mooring.seas.families` named in the table; depth : m.  Raises StudyError."""
    from hakobune.mooring.seas.families import PEAKED, families

    known = families(depth)
    if table.spectrum not in known:
        raise StudyError(f"{where}.spectrum is {table.spectrum!r}; allowed: {', '.join(known)}")
    if table.gamma is not None and table.spectrum not in PEAKED:
        raise StudyError(f"{where}.gamma is given for {table.spectrum}; allowed: with {', '.join(PEAKED)}")
    return known[table.spectrum]


def sea_of(where, waves, towards, depth):
    """The Sea of a table with the keys of a SeaTable, towards a direction, rad, in `depth` m.

    Raises StudyError.
    """
    from hakobune.mooring.environment.sea import Sea

    spectrum = spectrum_of(where, waves, depth)
    return Sea(spectrum, towards, spreading_of(where, waves, spectrum))


def shape_of(table):
    """Arguments of the shape of a spectrum"""
    return {} if table.gamma is None else {"gamma": table.gamma}


def spreading_of(where, table, spectrum):
    """The Spreading of a table, or None for long crests.  Raises StudyError."""
    try:
        return spreading(table.spreading, spectrum)
    except ValueError as error:
        raise StudyError(str(error).replace("--spreading", f"{where}.spreading")) from None


def spreading(text, spectrum):
    """The Spreading named by words as in `SPREADINGS`, None for None. Raises ValueError."""
    from hakobune.mooring.environment.spreading import CosinePower, HalfCosinePower, Mitsuyasu, WrappedNormal

    if text is None:
        return None
    makers = {
        "cosine": CosinePower,
        "half_cosine": HalfCosinePower,
        "mitsuyasu": lambda s: Mitsuyasu(s, spectrum.peak_omega),
        "wrapped_normal": lambda degrees: WrappedNormal(math.radians(degrees)),
    }
    kind, _, number = text.partition(":")
    try:
        maker, value = makers[kind], float(number)
    except (KeyError, ValueError):
        raise ValueError(f"--spreading is {text!r}; allowed: {SPREADINGS}") from None
    return maker(value)
