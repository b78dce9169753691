"""`hakobune series multi-point`: cases by the simplified method and in time; Table 3.5.5.5 compared with its printed
values."""

import warnings

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ...common.units import TONF
from ...scene.scene import make_scene
from ...simulate.findings import DEEP, SHALLOW
from ..beside import chosen, database, keep, one_by_one, result
from ..picture import Curve, Panel
from . import multi_point_statistics as statistics
from .multi_point_cases import BASES, KINDS, STRENGTH, cases, scene, study

SOURCE = "SR179 report (1982), section 3.5.5, tonf a line"
MODES = {"surge_m": 1.0, "sway_m": 1.0, "yaw_deg": np.pi / 180}  # slow motions and the unit of each
SLOW = ("quick", "spectrum", "slow", "total", "waves_alone")
NONE = np.full(3, np.nan)
OVER = {"height_m": "significant height, m", "depth_m": "depth, m", "period_s": "mean period, s", "lines": "lines"}
ALLOWED = 0.4  # fraction of the breaking load


def make(folder, only=None, seeds=1, hours=3.0, fresh=False):
    """The Result: each case, and Table 3.5.5.5 where its cases are among them; fails where a method has no answer"""
    wanted, solved = chosen({case.name: case for case in cases()}, only), {}
    found = []
    for case in one_by_one(wanted, lambda case: case.name):
        place = f"{case.floater}_{case.depth:g}m"
        if place not in solved:
            solved[place] = database(make_scene(scene(case)), folder / f"{place}.h5", fresh)
        found.append(computed(case, solved[place], folder / "cases", hours, seeds))
    kinds = [one.kind for one in wanted if one.floater == "A" and one.name.endswith("-T10")]
    table = [row for kind in kinds for row in statistics.table_rows(kind, solved["A_20m"], min(hours, 1.0))]
    notes = (*statistics.statements(table), *statements(found))
    lost = [fails(f"{one['case']}: {one['note']}") for one in found if one["note"]]
    source = f"{SOURCE}; {seeds} x {hours:g} h in time"
    return result("series multi-point", source, {"case": found, "record": table}, notes, lost)


def computed(case, db, folder, hours, seeds):
    """{column: number or text} of a case, nan where a method has no answer; tensions are the largest of all lines

    regular, irregular : values by the simplified method, in the report's regular wave and in irregular waves;
        simulated
    mean_and_X1000 : largest value of the simulation by the report's formula for Gaussian records (eq. 3.5.1.5)
    simplified_mean, simulated_mean : mean tensions; used : shares of the breaking load; method : method that the
        report selects by depth (section 5.5.3); T : natural periods under the steady forces, s; σ of slow motion by
        the quick rule, the spectrum and the simulation, σ of the total motion, and σ in waves alone, without wind,
        current and drift
    note : reason of missing values; studies, results and runs are files of the folder, made if missing
    """
    from ...design.kinds.in_time import simulated
    from ...design.kinds.mooring import run

    raw, notes = study(case, hours, seeds), []
    keep(folder / f"{case.name}.toml", raw)
    still = {key: value for key, value in raw.items() if key != "simulation"}

    def answer(words, made, *given):
        try:
            with warnings.catch_warnings(action="ignore"):  # warnings of lines and seas, kept in the files of the case
                return made(*given)
        except ValueError as error:
            notes.append(f"{words}: {' '.join(str(error).split())}")
            return NONE, NONE, NONE

    def simplified(method, period):
        waves = still["waves"] | {"method": method, "period": period}
        found = run(still | {"waves": waves}, db.path, folder / f"{case.name}_{method}.h5", [1.0])[0]
        return found.largest.max(), found.static.max(), found.breaking.min()

    def in_time(name):
        simulated(folder / f"{name}.toml", db.path, folder / f"{name}_runs.h5", [1.0])
        return _of_runs(folder / f"{name}_runs.h5")

    calm = {key: value for key, value in raw.items() if key not in ("wind", "current")}
    calm["simulation"] = raw["simulation"] | {"slow_drift": "none", "seeds": 1}
    keep(folder / f"{case.name}_waves.toml", calm)
    regular, steady, load = (np.max(v) for v in answer("simplified", simplified, "regular_wave", case.period))
    irregular = np.max(answer("simplified, irregular", simplified, "irregular", still["waves"]["period"])[0])
    period, quick, spectrum = answer("slow motion", _slow_motion, still, db)
    (largest, gaussian, mean), slow, total = answer("simulation", in_time, case.name)
    alone = answer("waves alone", in_time, f"{case.name}_waves")[1]
    share = TONF * case.lines / 12
    row = {"case": case.name, "floater": case.floater, "line": case.kind, "depth_m": case.depth, "lines": case.lines,
           "height_m": case.height, "wind_m_s": case.wind, "period_s": case.period}  # fmt: skip
    row |= {f"T_{mode}_s": float(T) for mode, T in zip(("surge", "sway", "yaw"), period, strict=True)}
    tensions = {"regular": regular, "irregular": irregular, "simulated": largest, "mean_and_X1000": gaussian,
                "simplified_mean": steady, "simulated_mean": mean}  # fmt: skip
    row |= {f"{name}_tonf": float(value / share) for name, value in tensions.items()}
    row |= {"simulated_over_regular": row["simulated_tonf"] / row["regular_tonf"],
            "simulated_over_irregular": row["simulated_tonf"] / row["irregular_tonf"],
            "regular_used": float(regular / load), "simulated_used": float(largest / (STRENGTH * share)),
            "method": method_of(case.depth)}  # fmt: skip
    for i, (mode, unit) in enumerate(MODES.items()):
        row |= {f"{kind}_{mode}": float(sigma[i] / unit)
                for kind, sigma in zip(SLOW, (quick, spectrum, slow, total, alone), strict=True)}  # fmt: skip
    return row | {"note": "; ".join(notes)}


def method_of(depth):
    """The method selected by the report's rule of depth"""
    return "simulation" if depth <= SHALLOW else "simplified" if depth >= DEEP else "larger of both"


def _slow_motion(raw, db):
    """Period, σ by the quick rule and by the spectrum of surge, sway and yaw, (3,) each"""
    from hakobune.mooring.studies.long_period import long_period

    from ...common.weather.gusts import gusts_of
    from ...moor.result import studied
    from ...moor.study import make_study

    made = make_study(raw | {"waves": raw["waves"] | {"motion_factor": 1e-3}})  # lines are asked at their mean alone
    found, hull = studied(made, db)
    slow = long_period(db, hull, found, gusts_of(made.wind))
    return slow.period, slow.quick, slow.by_spectrum


def _of_runs(path):
    """Largest tension, mean + X_1000 and mean, N; σ of the slow part and of all of surge, sway and yaw, (3,)"""
    from ...simulate.file import opened, summary_of

    with opened(path) as file:
        lines = [summary_of(file, f"tension {name}") for name in file["line"].asstr()[()]]
        rows = [summary_of(file, mode) for mode in ("surge", "sway", "yaw")]
    slow, total = (np.array([row[key] for row in rows]) for key in ("slow", "sigma"))
    gaussian = max(one["mean"] + one["extreme"] for one in lines)
    return (max(one["largest"] for one in lines), gaussian, max(one["mean"] for one in lines)), slow, total


def statements(found):
    """Lines on the report's statements of sections 3.5.4 and 3.5.5, each with the computed values"""
    named = {one["case"]: one for one in found}
    for text, names in STATEMENTS.items():
        if all(name in named for name in names):
            told = ", ".join(
                f"{named[name]['simulated_tonf']:.0f} (simplified {named[name]['regular_tonf']:.0f}) tonf at "
                f"{name.split('-', 1)[1]}" for name in names
            )  # fmt: skip
            yield f"report: {text}; computed: {told}"
    for near, where in (
        (lambda depth: depth <= SHALLOW, f"up to {SHALLOW:g}"),
        (lambda depth: depth >= DEEP, f"from {DEEP:g}"),
    ):
        for waves, name in (("the regular wave", "regular"), ("irregular waves", "irregular")):
            ratios = [one[f"simulated_over_{name}"] for one in found if near(one["depth_m"])]
            if ratios := [ratio for ratio in ratios if np.isfinite(ratio)]:
                above = sum(ratio > 1 for ratio in ratios)
                yield (
                    f"in {where} m of water the simulation exceeds the simplified method in {waves} in {above} of "
                    f"{len(ratios)} cases; ratios {min(ratios):.2f} to {max(ratios):.2f}"
                )
    more = [{mode: one[f"waves_alone_{mode}"] > 2 * one[f"spectrum_{mode}"] for mode in MODES} for one in found]
    driven = [one["case"] for one, by in zip(found, more, strict=True) if by["surge_m"] or by["sway_m"]]
    if driven:
        yield (
            "waves alone, without wind, current and drift, drive slow surge or sway of more than twice the linear "
            f"answer to slow forces in {len(driven)} of {len(found)} cases: {', '.join(driven)}"
        )


STATEMENTS = {
    "tension grows with the sea, most in shallow water": ("A-chain-Hs1.5", "A-chain-Hs3", "A-chain-base"),
    "it falls steeply with depth": ("A-chain-14m", "A-chain-base", "A-chain-50m"),
    "the sinker feels shallow water least": ("A-chain-14m", "A-buoy-14m", "A-sinker-14m"),
    "the period counts in shallow water": ("A-chain-T10", "A-chain-base", "A-chain-T20"),
    "more lines lower the simplified tension, and raise the simulated at 20 m by resonance":
        ("A-chain-base", "A-chain-24", "A-chain-36"),
    "B at 40 m: the simulation is below the simplified method": ("B-chain-base", "B-sinker-base"),
}  # fmt: skip


def pictures(made):
    """Design charts: tension of each floater over sea, depth, period and number of lines, by both methods"""
    out = {}
    for floater, base in BASES.items():
        own, panels = [row for row in made.detail["case"] if row["floater"] == floater], []
        for column, words in OVER.items():
            curves = [curve for kind in KINDS for curve in _along([r for r in own if r["line"] == kind], base, column)]
            if curves:
                axes = {"xlabel": words, "ylabel": "largest tension of a line, tonf", "yscale": "log"}
                panels.append(Panel("", curves, (STRENGTH, ALLOWED * STRENGTH), axes))
        if panels:
            title = (
                f"Floater {floater}; else {base.depth:g} m of water, {base.lines} lines, Hs {base.height:g} m, wind "
                f"{base.wind:g} m/s, {base.period:g} s; dotted: breaking load and {ALLOWED:g} of it"
            )
            out[f"multi_point_{floater}.png"] = (title, panels, 2, (5.6, 4.4))
    return out


def _along(rows, base, column):
    """[Curve] of the rows of a kind of line that differ from the base in one column, and in the wind with the sea"""
    at = {"height_m": base.height, "depth_m": base.depth, "period_s": base.period, "lines": base.lines}
    same = [row for row in rows if all(row[key] == value for key, value in at.items() if key != column)]
    if len(same) < 2:
        return []
    same.sort(key=lambda row: row[column])
    x, color = [row[column] for row in same], f"C{KINDS.index(same[0]['line'])}"
    ways = (("simulated", {"marker": "o"}), ("regular", {"marker": "s", "linestyle": "--", "mfc": "none"}))
    return [Curve(f"{same[0]['line']}, {name}", x, [row[f"{name}_tonf"] for row in same], {"color": color, **style})
            for name, style in ways]  # fmt: skip
