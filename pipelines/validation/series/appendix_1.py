"""`hakobune series appendix-1`: model tests of multi-point mooring, computed beside what was measured and calculated.

SR179 report (1982), appendix 1 and section 3.5.3, digitised in appendix_1.csv beside: models M3A and M3B, four lines at
45° from the corners to anchors 7.10 m away, chain of 0.871 kg/m in water, 7.530 m of it, or 7.482 m with a sinker of
2.87 kg.  Two calculations:

full     memory of the water, Newman's drift, wave drift damping, drag of the box in the water
report   coefficients at the mean frequency, drift by half waves, no more damping: the report's own (section 3.5.1.2)

The models are computed at the size of their prototypes, 36 and 46.5 times theirs, in fresh water, and told in theirs.

What the report does not tell is taken as: the sinker's upper part is S₁ = 3.355 m, its own 0.170 m half chain of each
part; axial stiffness of a studless chain of 7 mm.  Waves are ISSC of 2.19 s and of the measured σ; at 45°, where the
model's reflection is in the measured waves, of H₁/₃/3.774 of the tests ahead.

The tests were analysed over 204.8 s ahead and 102.4 s at 45°, in part of the transient, and are called indicative
where motion is slow (appendix 1, sections 5.2, 5.4). Of our records as long, ahead at gain 0.9, 90 % have σ of surge
from 3.2 to 6.9 cm on chain, from 3.2 to 4.6 cm with sinker, and sinker over chain from 0.5 to 1.25; at gain 0.5 the
chain's 1.5 to 3.1 cm leave out the 3.6 measured. Heave was too damped for its period to be seen (section 4.2): with a
tenth of critical damping beside that of waves, linear σ of heave is 1.61 and 1.92 cm at gain 0.9, measured 1.48 and
1.90.
"""

from __future__ import annotations

import csv
import io
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np
import tomli_w

from hakobune.bem.database import open_database
from hakobune.meshing.text_files import read_text
from hakobune.meshing.whole_files import write_whole

from ...common.outputs import check_folder
from ...common.quantities import StudyError
from ...common.units import KGF
from ...scene.scene import make_scene
from .databases import whole_database

TABLE = Path(__file__).parent / "appendix_1.csv"
DEPTH, PERIOD, SPAN = 1.2, 2.19, 7.1  # m, s, m
WEIGHT, STIFFNESS = 0.871, 539.0  # kg/m in water; tonf, 7 tonf/mm² on both legs of 7 mm
LENGTHS = {"chain": (7.530,), "sinker": (3.957 + 0.085, 3.355 + 0.085)}  # m, from the anchor up
SINKER_AIR, SINKER_WATER = 3.26, 2.87  # kg
LINES = {"bow starboard": (1, -1), "bow port": (1, 1), "stern port": (-1, 1), "stern starboard": (-1, -1)}
WAVES_AT_45 = {"0.9": 2.994, "0.7": 2.252, "0.5": 1.802}  # cm
HOURS = 3.0  # of each run, at the size of the prototype
VARIANTS = {"full": ("states", "newman"), "report": ("constant", "half-waves")}
MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
COLUMNS = ("surge_cm", "sway_cm", "heave_cm", "roll_deg", "pitch_deg", "yaw_deg",
           *(f"{name.replace(' ', '_')}_kgf" for name in LINES))  # fmt: skip


class Model(NamedTuple):
    """m, of a box; center : of gravity above the keel; gyration : m, about it; scale : prototype over model"""

    length: float
    beam: float
    height: float
    draft: float
    center: float
    gyration: tuple[float, float, float]
    scale: float


MODELS = {
    "M3A": Model(3.0, 2.5, 0.75, 0.25, 0.55, (0.929, 0.933, 1.276), 36.0),
    "M3B": Model(3.872, 1.936, 0.6, 0.1936, 0.458, (0.674, 1.12, 1.408), 46.5),
}
MEASURED_PERIODS = {  # tables 1.2, 1.3: tension at the model, kgf, measured and of a catenary; s: surge, sway, roll,
    # pitch, yaw; the horizontal ones are printed a tenth
    ("M3A", "chain"): (2.67, 2.55, 21.3, 21.6, np.nan, 1.86, 22.88),
    ("M3A", "sinker"): (3.15, 3.03, 17.6, 18.8, np.nan, np.nan, 19.04),
    ("M3B", "chain"): (2.78, 2.55, 16.48, 18.52, 1.78, 1.87, 17.04),
    ("M3B", "sinker"): (3.35, 3.03, 14.7, 15.69, 1.78, 1.81, 14.72),
}


class AtRest(NamedTuple):
    """A model on its lines in still water: kgf, of a line at the model; s, of surge, sway, roll, pitch, yaw"""

    model: str
    line: str
    tension: float
    periods: np.ndarray


class Outcome(NamedTuple):
    """Of one row of the table in one variant: wave : cm, σ; sigma, slow : {column: σ, its slow part}"""

    row: dict
    variant: str
    wave: float
    sigma: dict
    slow: dict


def make_appendix(folder, only, seeds, fresh):
    """Exit status.  Raises ValueError, one line."""
    from ...printing.console import new_console

    console, rows = new_console(), read_rows(only)
    check_folder(folder)
    (folder / "cases").mkdir(parents=True, exist_ok=True)
    for row, variant in [(row, variant) for row in rows for variant in VARIANTS]:
        path = folder / "cases" / f"{name_of(row)}_{variant}.toml"
        write_whole(path, tomli_w.dumps(simulation_of(row, variant, seeds)).encode())
    databases = {model: _database(model, folder, fresh) for model in MODELS}
    resting = [at_rest(model, line, open_database(databases[model])) for model, line in MEASURED_PERIODS]
    for one in resting:
        console.print(_of_rest(one), highlight=False, soft_wrap=True, markup=False)
    found, moved = [], bodies(open_database(databases["M3B"]))
    for row in rows:
        found += [computed(row, variant, moved[row["line"]], seeds) for variant in VARIANTS]
        for one in found[-len(VARIANTS) :]:
            console.print(_told(one), highlight=False, soft_wrap=True, markup=False)
    paths = folder / "appendix_1_rest.csv", folder / "appendix_1.csv"
    write_whole(paths[0], rest_text(resting).encode())
    write_whole(paths[1], table_text(found, seeds).encode())
    for line in summary(found):
        console.print(line, highlight=False, soft_wrap=True, markup=False)
    console.print(f"written: {', '.join(map(str, paths))}", highlight=False, soft_wrap=True, markup=False)
    return 0


def name_of(row):
    """Name of a row, as chain-0-0.9, of the report's calculation as chain-0-0.9-report"""
    return "-".join([row["line"], row["incidence_deg"], row["gain"], *["report"] * (row["source"] == "report")])


def read_rows(only=None):
    """Rows of the table as dictionaries of text.  Raises StudyError."""
    text = read_text(TABLE, StudyError, largest=1)
    rows = list(csv.DictReader(io.StringIO("\n".join(line for line in text.splitlines() if line[:1] != "#"))))
    if only is None:
        return rows
    wanted, names = [name.strip() for name in only.split(",")], [name_of(row) for row in rows]
    for word in wanted:
        if not any(f"{name}-".startswith(f"{word}-") for name in names):
            raise StudyError(f"--only {word!r} is no test; allowed: {', '.join(names)}, or chain, sinker-45, …")
    return [r for r, name in zip(rows, names, strict=True) if any(f"{name}-".startswith(f"{w}-") for w in wanted)]


def scene_of(name):
    """Raw tables of the scene of a model at the size of its prototype"""
    m = MODELS[name]
    size, time = m.scale, np.sqrt(m.scale)
    body = {"shape": "box", "length": m.length * size, "beam": m.beam * size, "draft": m.draft * size,
            "center_of_gravity": [0.0, 0.0, (m.center - m.draft) * size],
            "gyration": [k * size for k in m.gyration]}  # fmt: skip
    omegas = {"from": float(0.4 / time), "to": float(9.0 / time), "count": 60}
    waves = {"omegas": omegas, "headings_deg": {"from": 0, "to": 337.5, "count": 16}}
    return {"tolerance": 0.01, "water": {"depth": DEPTH * size, "density": 1000.0}, "bodies": [body], "waves": waves}


def study_of(name, line):
    """Raw tables of the study of a model on its lines, without waves, at the size of its prototype"""
    m = MODELS[name]
    size, away = m.scale, SPAN * np.sqrt(0.5)
    lines = []
    for one, (x, y) in LINES.items():
        fairlead = np.array([0.5 * m.length * x, 0.5 * m.beam * y]) * size
        anchor = fairlead + away * size * np.array([x, y])
        ends = {"name": one, "fairlead": [*fairlead.tolist(), 0.0], "anchor": anchor.tolist()}
        lines.append(ends | _line(line, size))
    kind = {"weight_kg_per_m": WEIGHT * size**2, "axial_stiffness_tonf": STIFFNESS * size**3}
    return {
        "water": {"depth": DEPTH * size},
        "hull": {key: value * size for key, value in
                 (("length", m.length), ("beam", m.beam), ("draft", m.draft), ("freeboard", m.height - m.draft))},
        "types": {"chain": kind},
        "lines": lines,
    }  # fmt: skip


def _line(kind, size):
    lengths = [length * size for length in LENGTHS[kind]]
    if len(lengths) == 1:
        return {"type": "chain", "length": lengths[0]}
    displaced = (SINKER_AIR - SINKER_WATER) / 1e3
    sinker = {"after_segment": 1, "mass": SINKER_AIR * size**3, "volume": displaced * size**3}
    return {"segments": [{"type": "chain", "length": length} for length in lengths], "bodies": [sinker]}


def simulation_of(row, variant, seeds):
    """Raw tables of the study of a row in time, at the size of the prototype"""
    (memory, drift), size = VARIANTS[variant], MODELS["M3B"].scale
    period, incidence = float(PERIOD * np.sqrt(size)), float(row["incidence_deg"])
    waves = {"height": 0.04 * _wave(row) * size, "period": period, "incidence_deg": incidence}
    simulation = {"duration_hours": HOURS, "seeds": seeds, "keep_series": 1, "memory": memory, "slow_drift": drift,
                  "wave_drift_damping": variant == "full", "dynamic_lines": "none", "qtf": "newman"}  # fmt: skip
    return study_of("M3B", row["line"]) | {"waves": waves, "simulation": simulation}


def _wave(row):
    """cm, σ of the waves of a row"""
    ahead = row["incidence_deg"] == "0"
    return float(row["wave_cm"]) if ahead else WAVES_AT_45[row["gain"]]


def at_rest(model, line, db):
    """`AtRest` of a model on its database"""
    from ...moor.command import studied
    from ...moor.study import make_study

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = studied(make_study(study_of(model, line)), db)[0]
    periods = np.asarray(result.at_rest.period)[[0, 1, 3, 4, 5]]
    size = MODELS[model].scale
    return AtRest(model, line, float(result.tension.mean()) / (KGF * size**3), periods / np.sqrt(size))


def bodies(db):
    """{kind of line: `Moored` M3B on it, at the size of the prototype}; one memory of the water for all"""
    from hakobune.mooring.motion.simulation import moored

    from ...moor.study import make_study

    out, memory = {}, None
    for line in LENGTHS:
        study = make_study(study_of("M3B", line))
        hull = study.hull_of(db.dimensions)
        system = study.system(hull, db.rotation_center, db.density, db.gravity)
        out[line] = moored(db, system, hull, memory=memory)
        memory = out[line].memory
    return out


def computed(row, variant, body, seeds):
    """`Outcome` of a row in a variant; body : its `Moored`; seeds : how many runs"""
    from hakobune.mooring.motion.simulation import simulate
    from hakobune.mooring.motion.statistics import parts

    from ...moor.study import make_study
    from ...simulate.study import plan_of

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of lines and seas, told by `simulate`
        plan = plan_of(make_study(simulation_of(row, variant, seeds)), body.reader.omega)
        runs = [simulate(body, plan.weather, plan.settings, seed) for seed in plan.seeds]
    squares = []
    for run in runs:
        records = np.hstack([run.motion, run.tension])[run.time >= 0]
        split = [parts(record - record.mean(), plan.settings.step, plan.split) for record in records.T]
        squares.append(np.square([(np.hypot(*pair), pair[0]) for pair in split]))
    values = np.sqrt(np.mean(squares, axis=0)) / _units("M3B")[:, None]
    sigma, slow = (dict(zip(COLUMNS, values[:, i].tolist(), strict=True)) for i in range(2))
    return Outcome(row, variant, _wave(row), sigma, slow)


def _units(model):
    """(10,) SI at the size of the prototype of a unit of each column"""
    size = MODELS[model].scale
    return np.array([*[size / 100] * 3, *[np.pi / 180] * 3, *[KGF * size**3] * len(LINES)])


def table_text(found, seeds):
    """CSV of Outcomes: σ in the units of the columns, with its slow part, measured or printed, and ours over it"""
    out = io.StringIO()
    out.write(
        "# hakobune series appendix-1: model M3B on four lines, SR179 report (1982), tables 1.5, 1.6 (tests) and "
        f"3.5.3.2 (the report's simulation); standard deviations; {seeds} x {HOURS:g} h of the prototype in time\n"
    )
    table = csv.writer(out, lineterminator="\n")
    table.writerow(["row", "printed_by", "line", "incidence_deg", "gain", "calculation", "wave_cm", "quantity",
                    "printed", "computed", "slow_part", "computed_over_printed"])  # fmt: skip
    for one in found:
        row = one.row
        for column in COLUMNS:
            if row[column]:
                printed, ours = float(row[column]), one.sigma[column]
                words = [row[key] for key in ("source", "line", "incidence_deg", "gain")]
                table.writerow([name_of(row), *words, one.variant, f"{one.wave:.4g}", column, row[column],
                                f"{ours:.4g}", f"{one.slow[column]:.4g}", f"{ours / printed:.3g}"])  # fmt: skip
    return out.getvalue()


def rest_text(resting):
    """CSV of models at rest beside tables 1.2 and 1.3"""
    out = io.StringIO()
    out.write(
        "# tension of a line at the model, kgf, and natural periods on the lines, s; _measured: tables 1.2, 1.3\n"
    )
    table = csv.writer(out, lineterminator="\n")
    names = ("surge_s", "sway_s", "roll_s", "pitch_s", "yaw_s")
    table.writerow(["model", "line", "tension_kgf", "tension_catenary_kgf", "tension_measured_kgf",
                    *names, *(f"{name}_measured" for name in names)])  # fmt: skip
    for one in resting:
        tension, catenary, *periods = MEASURED_PERIODS[one.model, one.line]
        numbers = ["" if np.isnan(v) else f"{v:.4g}" for v in (one.tension, catenary, tension, *one.periods, *periods)]
        table.writerow([one.model, one.line, *numbers])
    return out.getvalue()


def ratios(found, variant, column, incidence, source="test"):
    """Computed over measured σ of the rows of an incidence"""
    chosen = [one for one in found if _is(one, variant, source) and one.row["incidence_deg"] == incidence]
    return np.array([one.sigma[column] / float(one.row[column]) for one in chosen if one.row[column]])


def sinker_ratios(found, variant, column, incidence):
    """(n, 2) σ with the sinker over σ of the chain at the same gain of the wavemaker: computed, measured"""
    own = {name_of(one.row): one for one in found if _is(one, variant, "test")}
    pairs = []
    for name, one in own.items():
        other = own.get(name.replace("chain", "sinker", 1))
        if name.startswith(f"chain-{incidence}-") and other is not None and one.row[column]:
            measured = float(other.row[column]) / float(one.row[column])
            pairs.append((other.sigma[column] / one.sigma[column], measured))
    return np.array(pairs).reshape(-1, 2)


def summary(found):
    """Lines on all rows beside what was measured"""
    for incidence in ("0", "45"):
        for column in COLUMNS:
            parts = [(variant, ratios(found, variant, column, incidence)) for variant in VARIANTS]
            if all(len(values) for _, values in parts):
                told = ", ".join(f"{variant} {v.min():.2f} to {v.max():.2f}" for variant, v in parts)
                yield f"{incidence}°, {column.split('_kgf')[0].replace('_', ' ')}: computed over measured {told}"
        for column in ("surge_cm", "sway_cm", "yaw_deg"):
            for variant in VARIANTS:
                pairs = sinker_ratios(found, variant, column, incidence)
                if len(pairs):
                    ours, theirs = (f"{v.min():.2f} to {v.max():.2f}" for v in pairs.T)
                    yield f"{incidence}°, {column}, sinker over chain, {variant}: computed {ours}, measured {theirs}"


def _is(one, variant, source):
    return one.variant == variant and one.row["source"] == source


def _database(model, folder, fresh):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of M3B's printed radius of gyration in yaw, larger than a body can have
        return whole_database(make_scene(scene_of(model)), folder / f"{model}.h5", fresh)


def _of_rest(one):
    tension, catenary, *periods = MEASURED_PERIODS[one.model, one.line]
    names = ("surge", "sway", "roll", "pitch", "yaw")
    told = [
        f"{name} {ours:.3g} ({_number(theirs)}) s"
        for name, ours, theirs in zip(names, one.periods, periods, strict=True)
    ]
    return (
        f"{one.model} {one.line:6}: line {one.tension:.3f} kgf (catenary {catenary}, measured {tension}); "
        f"{', '.join(told)}"
    )


def _told(one):
    parts = [
        f"{column.replace('_', ' ')} {one.sigma[column]:.3g} ({one.row[column]})"
        for column in COLUMNS
        if one.row[column]
    ]
    return f"{name_of(one.row):22} {one.variant:6} {', '.join(parts)}"


def _number(value):
    return "–" if np.isnan(value) else f"{value:.4g}"
