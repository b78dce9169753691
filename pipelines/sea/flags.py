"""Flags of `hakobune sea`: the spectrum, the record generated from the spectrum, and the reading of a given record."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ..common.weather import SPREADINGS
from ..scene.flags import _flag


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class SpectrumFlags:
    """The spectrum, where no record is given."""

    spectrum: Annotated[str, _flag("issc, mitsuyasu_bretschneider, bretschneider, jonswap, tma or ochi_hubble")] = (
        "issc"
    )
    height: Annotated[float | None, _flag("significant wave height, m")] = None
    mean_period: Annotated[float | None, _flag("T01, s; one period of any kind is needed")] = None
    zero_crossing_period: Annotated[float | None, _flag("T02, s")] = None
    energy_period: Annotated[float | None, _flag("Te, s")] = None
    peak_period: Annotated[float | None, _flag("Tp, s")] = None
    significant_period: Annotated[float | None, _flag("T1/3, s")] = None
    gamma: Annotated[float | None, _flag("peak enhancement of jonswap and tma [3.3]")] = None
    wind_speed: Annotated[float | None, _flag("m/s at 10 m; with fetch instead of height and period, jonswap")] = None
    fetch: Annotated[float | None, _flag("m, with wind-speed")] = None
    table: Annotated[
        Path | None,
        _flag("file of a spectrum, as in a study's sea, or CSV of frequency_hz,density_m2_hz or omega_rad_s,…"),
    ] = None
    time: Annotated[
        str | None, _flag("time of the spectrum, for a table with several times: as in the file, or its beginning")
    ] = None

    @property
    def periods(self):
        """{kind: s or None}"""
        from hakobune.mooring.environment.periods import KINDS

        return {kind: getattr(self, kind) for kind in KINDS}


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class RecordFlags:
    """Settings of the record that is generated from the spectrum, or of the reading of a given record."""

    record: Annotated[Path | None, _flag("write a record of the spectrum to this CSV file")] = None
    duration: Annotated[float | None, _flag("s, duration of the generated record [3600]")] = None
    step: Annotated[float | None, _flag("s, step of the generated record [0.5], or of a record file without times")] = (
        None
    )
    seed: Annotated[str | None, _flag("seed; the same seed gives the same record [1]")] = None
    point: Annotated[str | None, _flag("x,y m, point of the generated record [0,0]")] = None
    components: Annotated[
        str | None, _flag("number of wave components of the generated record [500, more if random]")
    ] = None
    frequencies: Annotated[
        str | None, _flag("frequencies of the components: equal_step or equal_energy [equal_step]")
    ] = None
    amplitudes: Annotated[
        str | None, _flag("amplitudes of the components: deterministic or random [deterministic]")
    ] = None
    direction: Annotated[float | None, _flag("degrees the waves travel to (0: +x, 90: +y) [0]")] = None
    spreading: Annotated[str | None, _flag(f"spreading about the heading: {SPREADINGS} [none: long crests]")] = None
    depth: Annotated[
        float | None, _flag("water depth, m; inf for deep water [inf]; for tma, and to check breaking")
    ] = None


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class ReadingFlags:
    """How a given record is read and its spectrum estimated."""

    column: Annotated[str | None, _flag("name of the column of elevations [the second]")] = None
    segment: Annotated[float | None, _flag("s, length of the averaged periodograms [an eighth of the record]")] = None
