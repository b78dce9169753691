"""`hakobune series multi-point`: every case by the simplified method and in time, in one table and as charts."""

from __future__ import annotations

import csv
import io
import warnings
from typing import NamedTuple

import numpy as np
import tomli_w

from hakobune.meshing.whole_files import write_whole
from hakobune.mooring.criteria.failing import fails

from ...common.outputs import check_folder
from ...common.quantities import StudyError
from ...common.units import TONF
from ...printing.verdict import tell
from ...simulate.findings import DEEP, SHALLOW
from . import multi_point_statistics as statistics
from .databases import whole_database
from .multi_point_cases import FLOATERS, STRENGTH, cases, scene, study

MOST_SEEDS, LONGEST = 100, 24.0  # h
MODES = ("surge", "sway", "yaw")


class Result(NamedTuple):
    """Of a Case, nan where a method has no answer; tensions in tonf a line, the largest of all lines

    regular, irregular : by the simplified method, in the report's regular wave and in irregular waves; simulated
    report_extreme : mean + X_1000 of the simulation, the report's largest (eq. 3.5.1.5), for Gaussian records
    mean : steady, by the simplified method and the simulation; used : shares of the breaking load, of regular and
    simulated
    period : (3,) s of surge, sway, yaw under the steady forces; quick, spectrum, slow : (3,) σ of their slow motion by
    the quick rule, the spectrum and the simulation, m, rad; total : (3,) σ of all of it; alone : (3,) slow σ by waves
    alone, without wind, current and drift
    notes : why values are missing
    """

    case: object
    regular: float
    irregular: float
    simulated: float
    report_extreme: float
    mean: tuple[float, float]
    used: tuple[float, float]
    period: np.ndarray
    quick: np.ndarray
    spectrum: np.ndarray
    slow: np.ndarray
    total: np.ndarray
    alone: np.ndarray
    notes: tuple[str, ...]

    @property
    def method(self):
        """Which method the report's rule of depth takes here (section 5.5.3)"""
        depth = self.case.depth
        return "simulation" if depth <= SHALLOW else "simplified" if depth >= DEEP else "larger of both"

    @property
    def larger(self):
        """Which method gives the larger tension"""
        return "" if np.isnan(self.ratio) else "simulation" if self.ratio > 1 else "simplified"

    @property
    def ratio(self):
        """Simulated tension over that of the simplified method in the regular wave"""
        return self.simulated / self.regular

    @property
    def irregular_ratio(self):
        """Simulated tension, a largest value, over that of the simplified method in irregular waves, one too"""
        return self.simulated / self.irregular


def make_series(folder, only, seeds, hours, fresh):
    """Exit status: 0, or 1 with a case that has no answer by one of the methods.  Raises ValueError, one line."""
    from ...printing.console import new_console

    console, chosen = new_console(), cases(only)
    if not 1 <= seeds <= MOST_SEEDS:
        raise StudyError(f"--seeds is {seeds}; allowed: 1 to {MOST_SEEDS}")
    if not 0.1 <= hours <= LONGEST:
        raise StudyError(f"--hours is {hours:g}; allowed: 0.1 to {LONGEST:g}")
    check_folder(folder)
    (folder / "cases").mkdir(parents=True, exist_ok=True)
    databases, results = {}, []
    for number, case in enumerate(chosen, 1):
        place = f"{case.floater}_{case.depth:g}m"
        if place not in databases:
            databases[place] = _solved(case, folder / f"{place}.h5", fresh)
        results.append(computed(case, databases[place], folder / "cases", hours, seeds))
        _tell(console, number, len(chosen), results[-1])
    written = [folder / "multi_point.csv"]
    write_whole(written[0], table_text(results, hours, seeds).encode())
    from .multi_point_charts import draw

    written += draw(results, folder)
    rows = _printed_table(chosen, databases, hours)
    if rows:
        written.append(folder / "multi_point_table_3_5_5_5.csv")
        write_whole(written[-1], statistics.table_text(rows, min(hours, 1.0)).encode())
        for line in statistics.statements(rows):
            console.print(line, highlight=False, soft_wrap=True, markup=False)
    for line in statements(results):
        console.print(line, highlight=False, soft_wrap=True, markup=False)
    status = tell((fails(f"{one.case.name}: {note}") for one in results for note in one.notes), console)
    console.print(f"written: {', '.join(map(str, written))}", highlight=False, soft_wrap=True, markup=False)
    return status


def computed(case, database, folder, hours, seeds):
    """Result of a case; its studies, results and runs are files of the folder, made where they are not there"""
    from ...design.kinds.in_time import simulated
    from ...design.kinds.mooring import run

    raw, notes = study(case, hours, seeds), []
    still = {key: value for key, value in raw.items() if key != "simulation"}
    path, runs = folder / f"{case.name}.toml", folder / f"{case.name}_runs.h5"
    write_whole(path, tomli_w.dumps(raw).encode())

    def answer(words, made, otherwise):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of lines and seas, kept in the files of the case
                return made()
        except ValueError as error:
            notes.append(f"{words}: {' '.join(str(error).split())}")
            return otherwise

    def simplified(method):
        period = case.period if method == "regular_wave" else still["waves"]["period"]
        waves = still["waves"] | {"method": method, "period": period}
        found = run(still | {"waves": waves}, database, folder / f"{case.name}_{method}.h5", [1.0])[0]
        return np.array([found.largest.max(), found.static.max(), found.breaking.min()])

    def in_time():
        simulated(path, database, runs, [1.0])
        return _of_runs(runs)

    def by_waves():
        calm = {key: value for key, value in raw.items() if key not in ("wind", "current")}
        calm["simulation"] = raw["simulation"] | {"slow_drift": "none", "seeds": 1}
        place, kept = folder / f"{case.name}_waves.toml", folder / f"{case.name}_waves_runs.h5"
        write_whole(place, tomli_w.dumps(calm).encode())
        simulated(place, database, kept, [1.0])
        return _of_runs(kept)[1]

    none = np.full(3, np.nan)
    regular, steady, load = answer("simplified", lambda: simplified("regular_wave"), none)
    irregular = answer("simplified, irregular", lambda: simplified("irregular"), none)[0]
    slow_motion = answer("slow motion", lambda: _slow_motion(still, database), (none, none, none))
    (largest, gaussian, mean), slow, total = answer("simulation", in_time, (none, none, none))
    alone = answer("waves alone", by_waves, none)
    share = TONF * case.lines / 12
    used = regular / load, largest / (STRENGTH * share)
    tensions = np.array([regular, irregular, largest, gaussian]) / share
    return Result(case, *tensions, (steady / share, mean / share), used, *slow_motion, slow, total, alone, tuple(notes))


def _printed_table(chosen, databases, hours):
    """Rows of table 3.5.5.5, of the kinds of line whose printed case is chosen"""
    kinds = [one.kind for one in chosen if one.floater == "A" and one.name.endswith("-T10")]
    return [row for kind in kinds for row in statistics.table_rows(kind, databases["A_20m"], min(hours, 1.0))]


def _solved(case, path, fresh):
    """The path of the database of a case, solved where it is not there"""
    from ...scene.scene import make_scene

    return whole_database(make_scene(scene(case)), path, fresh)


def _slow_motion(raw, database):
    """Period, σ by the quick rule and by the spectrum of surge, sway and yaw, (3,) each"""
    from hakobune.bem.database import open_database
    from hakobune.mooring.studies.long_period import long_period

    from ...common.weather.gusts import gusts_of
    from ...moor.command import studied
    from ...moor.study import make_study

    made = make_study(raw | {"waves": raw["waves"] | {"motion_factor": 1e-3}})  # lines are asked at their mean alone
    db = open_database(database)
    result, hull = studied(made, db)
    found = long_period(db, hull, result, gusts_of(made.wind))
    return found.period, found.quick, found.by_spectrum


def _of_runs(path):
    """Largest tension, mean + X_1000 and mean, N; σ of the slow part and of all of surge, sway and yaw, (3,)"""
    from ...simulate.file import opened, summary_of

    with opened(path) as file:
        lines = [summary_of(file, f"tension {name}") for name in file["line"].asstr()[()]]
        rows = [summary_of(file, mode) for mode in MODES]
    slow, total = (np.array([row[key] for row in rows]) for key in ("slow", "sigma"))
    gaussian = max(one["mean"] + one["extreme"] for one in lines)
    return (max(one["largest"] for one in lines), gaussian, max(one["mean"] for one in lines)), slow, total


def table_text(results, hours, seeds):
    """CSV of Results"""
    out = io.StringIO()
    out.write(
        f"# hakobune series multi-point: SR179 report (1982), section 3.5.5; {seeds} x {hours:g} h in time; tonf "
    )
    out.write("a line, m, deg, s; T: natural periods under the steady forces; regular, irregular: simplified method; ")
    out.write("method: the report's rule of depth\n")
    table = csv.writer(out, lineterminator="\n")
    slow = [f"{mode}_{kind}_sigma" for mode in MODES for kind in ("quick", "spectrum", "slow", "total", "waves_alone")]
    table.writerow(["case", "floater", "line", "depth_m", "lines", "Hs_m", "wind_m_s", "period_s", "depth_over_draft",
                    *(f"T_{mode}" for mode in MODES), *(f"T_{mode}_over_period" for mode in MODES),
                    "regular", "irregular", "simulated", "simulated_mean_and_X1000",
                    "simulated_over_regular", "simulated_over_irregular", "simplified_mean", "simulated_mean",
                    "regular_used", "simulated_used", "method", "larger", *slow, "note"])  # fmt: skip
    for one in results:
        c, degrees = one.case, np.array([1.0, 1.0, 180 / np.pi])
        parts = np.stack([part * degrees for part in (one.quick, one.spectrum, one.slow, one.total, one.alone)], axis=1)
        numbers = [*c[3:], c.depth / FLOATERS[c.floater].draft, *one.period, *(one.period / c.period)]
        numbers += [
            one.regular,
            one.irregular,
            one.simulated,
            one.report_extreme,
            one.ratio,
            one.irregular_ratio,
            *one.mean,
            *one.used,
        ]
        table.writerow([c.name, c.floater, c.kind, *map(_number, numbers), one.method, one.larger,
                        *map(_number, parts.ravel()), '; '.join(one.notes)])  # fmt: skip
    return out.getvalue()


def statements(results):
    """Lines on the report's statements of sections 3.5.4 and 3.5.5, each with what is computed"""
    named = {one.case.name: one for one in results}
    for text, names, value in STATEMENTS:
        if all(name in named for name in names):
            yield f"report: {text}; computed: {value(*(named[name] for name in names))}"
    shallow = [one for one in results if one.case.depth <= SHALLOW and np.isfinite(one.ratio)]
    deep = [one for one in results if one.case.depth >= DEEP and np.isfinite(one.ratio)]
    for own, where in ((shallow, f"up to {SHALLOW:g} m"), (deep, f"from {DEEP:g} m")):
        for waves, name in (("the regular wave", "ratio"), ("irregular waves", "irregular_ratio")):
            ratios = [getattr(one, name) for one in own if np.isfinite(getattr(one, name))]
            if ratios:
                above = sum(ratio > 1 for ratio in ratios)
                yield (
                    f"in {where} of water the simulation exceeds the simplified method in {waves} in {above} of "
                    f"{len(ratios)} cases; ratios {min(ratios):.2f} to {max(ratios):.2f}"
                )
    driven = [one for one in results if one.alone[0] > 2 * one.spectrum[0] or one.alone[1] > 2 * one.spectrum[1]]
    if driven:
        names = ", ".join(one.case.name for one in driven)
        yield (
            "waves alone, without wind, current and drift, drive slow surge or sway of more than twice the linear "
            f"answer to slow forces in {len(driven)} of {len(results)} cases: {names}"
        )


def _tensions(*several):
    return ", ".join(f"{one.simulated:.0f} (simplified {one.regular:.0f}) tonf at {_where(one)}" for one in several)


def _where(one):
    return one.case.name.split("-", 1)[1]


STATEMENTS = (
    ("tension grows with the sea, most in shallow water", ("A-chain-Hs1.5", "A-chain-Hs3", "A-chain-base"), _tensions),
    ("it falls steeply with depth", ("A-chain-14m", "A-chain-base", "A-chain-50m"), _tensions),
    ("the sinker feels shallow water least", ("A-chain-14m", "A-buoy-14m", "A-sinker-14m"), _tensions),
    ("the period counts in shallow water", ("A-chain-T10", "A-chain-base", "A-chain-T20"), _tensions),
    ("more lines lower the simplified tension, and raise the simulated at 20 m by resonance",
     ("A-chain-base", "A-chain-24", "A-chain-36"), _tensions),
    ("B at 40 m: the simulation is below the simplified method", ("B-chain-base", "B-sinker-base"), _tensions),
)  # fmt: skip


def _number(value):
    return "" if np.isnan(value) else f"{value:.5g}"


def _tell(console, number, count, one):
    words = (
        f"{number:{len(str(count))}}/{count}  {one.case.name:16} simplified {one.regular:6.0f}, simulated "
        f"{one.simulated:6.0f} tonf a line; slow surge σ {one.quick[0]:.2g}, {one.spectrum[0]:.2g}, "
        f"{one.slow[0]:.2g}, {one.alone[0]:.2g} m (quick, spectrum, simulated, by waves alone)  {'; '.join(one.notes)}"
    )
    console.print(words.rstrip(), highlight=False, soft_wrap=True, markup=False)
