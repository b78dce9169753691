"""`hakobune series appendix-2`: the tests of model M3B at a single point, computed beside what was measured.

SR179 report (1982), appendix 2, digitised in appendix_2.csv beside: three chains, an intermediate buoy of 5.8 kg on two
hawsers, or a contact buoy at the bow.  What the report does not tell is taken as: lines at ±60° and 180° of the waves,
0.72 and 0.82 kgf in them at rest; nylon hawsers of 5 mm, T = 4 kN (ε/0.25)², 0.4 m apart at the bow; chains made fast
0.05 m under water, hawsers 0.05 m over it, on a gauge on the deck of the buoy, so that their pull tilts it: by that it
yields three times as far as they stretch.  A buoy that stays upright snaps two to three times as hard as was measured
in waves alone.  Significant loads are means of the highest third of the crests, as of records of a tank.

Pitch is that of the run on the intermediate buoy, which is one equation with it.  With a contact buoy it is that of the
sea's spectrum: the buoyancy of 0.2 × 0.5 m hinged 2.061 m ahead is a spring between the bow and the surface of the
waves, and the free model pitches 1 to 2 % more than that; 8 to 10 % more than with a spring against still water.  These
are the ends of what a contact buoy can do; on an intermediate one 15 to 19 % more were measured, which is also more
than the free model does in any sea of that spectrum, and its hawsers are too weak to lift it there.
"""

from __future__ import annotations

import csv
import io
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.bem.database import open_database
from hakobune.bem.waves import wavenumber
from hakobune.meshing.whole_files import write_whole
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.single_point.equilibria import equilibria
from hakobune.mooring.single_point.scope import highest_third

from ...common.outputs import check_folder, check_output
from ...common.quantities import StudyError
from ...common.units import KGF
from ...scene.scene import make_scene
from ...single_point.running import run
from ...single_point.study import make
from ...single_point.tables import make_study
from .databases import whole_database
from .single_point import is_table

TABLE = Path(__file__).parent / "appendix_2.csv"
LENGTH, BEAM, DEPTH, PERIOD = 3.872, 1.936, 1.2, 2.19
PIVOT, BUOY_AREA = 2.061, 0.2 * 0.5  # m ahead of the middle, m²
DRAFTS = {"10": (0.194, 2.36, (0.348, 0.289, 0.364)), "20": (0.097, 2.63, (0.298, 0.318, 0.350))}
BUOY = {"mass": 0.0058, "diameter": 0.33, "height": 0.11, "hawser_z": 0.05}  # t, m; its deck floats at 0.042 m
DURATION = 360.0  # s
SEAS, LIFTED = np.linspace(1.6, 4.0, 13), 1.0  # s; kgf, of hawsers of 4 kgf that rise by 14°
SCALE, SAFETY, LARGEST_KGF = 26.0, 4.0, 1.5  # to the prototype; on the largest line tension of the model
HAWSERS = ("hawser", "hawser_kgf", "of a hawser at the bow"), ("on_buoy", "buoy_kgf", "on the buoy")
REPORT_CHAINS = {"2": 42, "3": 36, "R3S": 32}  # mm; R3S for the report's grade 4, which has no formula there


class Outcome(NamedTuple):
    """Of one test: pitch, ° significant amplitude; hawser, on_buoy : kgf significant, of one at the bow, of both

    massless : kgf, on the buoy by a buoy without mass

    settled : s of the heading to 1° of rest, nan where it is not; slews : whether it goes on
    periods : s, of the small motions, as text
    """

    row: dict
    pitch: float
    hawser: float
    on_buoy: float
    massless: float
    settled: float
    slews: bool
    periods: str


def make_appendix(folder, only, fresh):
    """Exit status.  Raises ValueError, one line."""
    from ...printing.console import new_console

    console = new_console()
    rows = read_rows(only)
    path = folder / "appendix_2.csv"
    check_folder(folder)
    folder.mkdir(parents=True, exist_ok=True)
    check_output(path, "a table of the series", is_table, (".csv",))
    databases = {wide: _database(wide, folder, fresh) for wide in sorted({row["B_over_d"] for row in rows})}
    found = []
    for row in rows:
        found.append(computed(row, databases[row["B_over_d"]]))
        console.print(_told(found[-1]), highlight=False, soft_wrap=True, markup=False)
    write_table(path, found)
    for line in (*summary(found), *ceilings(databases), *chains()):
        console.print(line, highlight=False, soft_wrap=True, markup=False)
    console.print(f"written: {path}", highlight=False, soft_wrap=True, markup=False)
    return 0


def read_rows(only=None):
    """Tests as dictionaries of text.  Raises StudyError."""
    lines = [line for line in TABLE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    if only is None:
        return rows
    wanted = [name.strip() for name in only.split(",")]
    unknown = [name for name in wanted if name not in {row["case"] for row in rows}]
    if unknown:
        raise StudyError(f"--only names {unknown[0]!r}; allowed: tests of the table, as {rows[0]['case']}")
    return [row for row in rows if row["case"] in wanted]


def scene_of(wide):
    """Scene of the model with a B/d, "10" or "20" """
    draft, KG, gyration = DRAFTS[wide]
    return make_scene(
        {
            "tolerance": 0.02,
            "want": ["radiation", "diffraction", "motions", "drift", "limits"],
            "water": {"depth": DEPTH, "density": 1000.0},
            "bodies": [
                {
                    "shape": "box",
                    "length": LENGTH,
                    "beam": BEAM,
                    "draft": draft,
                    "center_of_gravity": [0.0, 0.0, (KG - 1) * draft],
                    "gyration": [gyration[0] * BEAM, gyration[1] * LENGTH, gyration[2] * LENGTH],
                }
            ],
            "waves": {"periods": {"from": 0.85, "to": 9.0, "count": 26}, "headings_deg": [0, 22.5, 45, 67.5, 90]},
        }
    )


def study_of(row, scheme=None, seed=1):
    """Nested dictionaries of the study of a test; seed : of its waves"""
    contact = row["buoy"] == "contact"
    current, height = float(row["current_cm_s"]) / 100, float(row["height_cm"]) / 100
    raw = {
        "water": {"depth": DEPTH},
        "hull": {"length": LENGTH, "beam": BEAM, "draft": DRAFTS[row["B_over_d"]][0], "freeboard": 0.4},
        "attachment": {"x": PIVOT if contact else 0.5 * LENGTH},
        "buoy": {"z": -0.05} if contact else {"z": -0.05, **BUOY},
        "types": {"chain": {"weight_kg_per_m": 0.42}},
        "mooring": {
            "type": "chain",
            "length": 6.285,
            "headings_deg": [60, 180, 300],
            "top_tension_kN": (0.82 if contact else 0.72) * KGF / 1e3,
        },
        "slewing": {"duration": DURATION, "offset_deg": float(row["heading_deg"]), "seed": seed},
    }
    if not contact:
        raw["hawser"] = {
            "length": 1.25, "count": 2, "spacing": 0.4, "breaking_load_kN": 4.0, "strain": 0.25, "exponent": 2.0,
        }  # fmt: skip
    if current > 0:
        raw["current"] = {"speed": current, "incidence_deg": 0.0, "turning": {}, "waves": "still"}
    if height > 0:
        raw["waves"] = {"height": height, "period": PERIOD, "incidence_deg": 0.0}
        raw["slewing"]["scheme"] = scheme or ("two_scale" if contact else "full")
        raw["slewing"]["slow_step"] = 2.0
        if raw["slewing"]["scheme"] == "full":
            raw["slewing"]["step"] = 0.1
    return raw


def computed(row, db, seed=1) -> Outcome:
    """Outcome of a test; seed : of its waves"""
    study = make_study(study_of(row, seed=seed))
    point = make(study, db).point
    best = max(equilibria(point), key=lambda one: np.cos(one.heading))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        made = run(study, point, best, db)
        record = made.record
        waves, contact = study.waves is not None, row["buoy"] == "contact"
        massless = np.nan
        if waves and not contact:
            massless = _on_buoy(run(make_study(study_of(row, "two_scale", seed)), point, best, db).record)
    away = np.degrees(np.abs(record.heading - best.heading))
    outside = np.flatnonzero(away > 1.0)
    last = int(outside[-1]) + 1 if len(outside) else 0
    settled = float(record.time[last]) if last < len(away) else np.nan
    hawser, both = (_hawser(record), _on_buoy(record)) if waves and not contact else (np.nan, np.nan)
    periods = " ".join(f"{2 * np.pi / root:.0f}" for root in sorted(best.roots.imag, reverse=True) if root > 1e-6)
    pitch = np.nan
    if waves:
        late = record.time > record.time[-1] / 3
        own = 2 * float(np.degrees(record.wave[late, 4].std()))
        pitch = pitch_amplitude(db, study.waves.height) if contact else own
    slews = made.cycle.stays and not best.slewing.stable  # a stable heading that wanders is driven by slow drift
    return Outcome(row, pitch, hawser, both, massless, settled, slews, periods)


def pitch_amplitude(db, height, period=PERIOD, area=BUOY_AREA):
    """° significant amplitude, 2σ, with a contact buoy in head waves of an ISSC spectrum; area : m², of the buoy"""
    lever, spring = np.array([0, 0, 1.0, 0, -PIVOT, 0]), db.density * db.gravity * area
    body, plane = db.reader.restrained(stiffness=spring * np.outer(lever, lever)), [0, 2, 4]
    omega = frequencies(body)
    A, B = body.coefficients(omega)
    s = -1j * omega[:, None, None]
    Z = s**2 * (body.inertia + A) + s * (B + body.damping) + body.stiffness
    k = wavenumber(omega, db.water_depth, db.gravity)
    lifted = spring * np.exp(-1j * k * PIVOT)[:, None] * lever  # by waves towards π
    force = body.forces(omega, [np.pi])[:, 0] + lifted
    X = np.abs(np.linalg.solve(Z[:, plane][:, :, plane], force[:, plane, None])[:, 2, 0])
    density = issc(height, mean_period=period).density(omega)
    return float(2 * np.degrees(np.sqrt(np.trapezoid(X**2 * density, omega))))


def summary(found):
    """Lines on all tests beside the measured means"""
    for wide in ("10", "20"):
        for buoy in ("intermediate", "contact"):
            pairs = _pairs(found, "pitch", "pitch_deg", wide, buoy)
            if len(pairs):
                heights = np.array(
                    [float(one.row["height_cm"]) for one in found if _is(one, "pitch", "pitch_deg", wide, buoy)]
                )
                ours, measured = (2 * pairs / heights[:, None]).mean(axis=0)
                yield f"B/d {wide}, {buoy}: σ of pitch over σ of the waves {ours:.3f} °/cm, measured {measured:.3f}"
    for words, current in (("waves and current", True), ("waves alone", False)):
        own = [one for one in found if (float(one.row["current_cm_s"]) > 0) == current]
        yield from _hawsers(words, own)
    late = [one for one in found if np.isfinite(one.settled)]
    slewing = [one.row["case"] for one in found if one.slews]
    names = ", ".join(slewing) or "none"
    yield f"slewing that stays: {names} of {len(found)}; the heading comes to rest in {len(late)}"


def ceilings(databases):
    """Lines on the largest pitch of the free model in an ISSC sea of any period, from {B/d: database}

    What was measured on the intermediate buoy lies above; pulls of a hawser are too small to lift it there.
    """
    for wide, db in databases.items():
        sigmas = [pitch_amplitude(db, 0.04, period, 0.0) / 2 for period in SEAS]
        righting = db.reader.stiffness[4, 4] * np.radians(1.0)
        moment = LIFTED * KGF * 0.5 * LENGTH / righting
        yield (
            f"B/d {wide}: the free model pitches {max(sigmas):.3f} °/cm at most, σ over σ, in an ISSC sea of any mean "
            f"period from {SEAS[0]:.2g} to {SEAS[-1]:.2g} s; {LIFTED:g} kgf up at its bow turn it {moment:.2f}°"
        )


def _hawsers(words, found):
    """Lines on the hawsers of tests, computed beside measured"""
    for name, column, place in HAWSERS:
        chosen = [one for one in found if _is(one, name, column)]
        if chosen:
            ours, measured = np.mean([(getattr(one, name), float(one.row[column])) for one in chosen], axis=0)
            without = f", {np.mean([one.massless for one in chosen]):.2f} without its mass"
            left = without if name == "on_buoy" else ""
            yield f"{words}, {len(chosen)} tests: {ours:.2f} kgf {place}{left}, measured {measured:.2f}"


def chains():
    """Lines on the chain that the largest tension asks for at full scale"""
    load = LARGEST_KGF * SCALE**3 / 1e3 * SAFETY
    for grade, printed in REPORT_CHAINS.items():
        d = next(d for d in range(10, 200) if _breaking(grade, d) >= load)
        yield (
            f"chain for {load:.1f} tonf ({LARGEST_KGF} kgf × {SCALE:g}³ × {SAFETY:g}), grade {grade}: {d} mm; the "
            f"report {printed} mm, which breaks at {_breaking(grade, printed):.1f} tonf"
        )


def write_table(path, found):
    """CSV of outcomes beside the measured values"""
    out = io.StringIO()
    out.write("# hakobune series appendix-2: model M3B at a single point, SR179 report (1982), appendix 2; kgf, °, s\n")
    table = csv.writer(out, lineterminator="\n")
    table.writerow([*found[0].row, *Outcome._fields[1:]])
    for one in found:
        numbers = ["" if np.isnan(v) else f"{v:.4g}" for v in one[1:6]]
        table.writerow([*one.row.values(), *numbers, "yes" if one.slews else "no", one.periods])
    write_whole(path, out.getvalue().encode())


def _database(wide, folder, fresh):
    return open_database(whole_database(scene_of(wide), folder / f"M3B_Bd{wide}.h5", fresh))


def _hawser(record):
    """kgf, significant, mean of the hawsers, after the first third of a run, in which the heading settles"""
    late = record.time > record.time[-1] / 3
    return float(np.mean([highest_third(one) for one in record.hawser[late].T])) / KGF


def _on_buoy(record):
    """kgf, significant, of all hawsers together"""
    late = record.time > record.time[-1] / 3
    return highest_third(record.hawser[late].sum(axis=1)) / KGF


def _breaking(grade, d):
    name = f"{grade} studlink {d} mm" if grade.startswith("R") else f"grade {grade} studlink {d} mm"
    return line_type(name).breaking_load / KGF / 1e3


def _is(one, name, column, wide=None, buoy=None):
    row = one.row
    right = (wide is None or row["B_over_d"] == wide) and (buoy is None or row["buoy"] == buoy)
    return right and row[column] != "" and np.isfinite(getattr(one, name))


def _pairs(found, name, column, wide=None, buoy=None):
    """(n, 2) computed and measured"""
    chosen = [one for one in found if _is(one, name, column, wide, buoy)]
    return np.array([(getattr(one, name), float(one.row[column])) for one in chosen]).reshape(-1, 2)


def _told(one):
    row = one.row

    def beside(value, column, unit):
        return f"{'–' if np.isnan(value) else f'{value:.2f}'} ({row[column] or '–'}) {unit}"

    rest = "does not settle" if np.isnan(one.settled) else f"at rest in {one.settled:.0f} s"
    parts = (
        f"{row['case']:5} {row['buoy']:12} B/d {row['B_over_d']}: pitch {beside(one.pitch, 'pitch_deg', '°')}",
        f"hawser {beside(one.hawser, 'hawser_kgf', 'kgf')}, on the buoy {beside(one.on_buoy, 'buoy_kgf', 'kgf')}",
        f"without mass {'–' if np.isnan(one.massless) else f'{one.massless:.2f}'}",
        f"from {row['heading_deg']}° {rest}",
        f"periods {one.periods} ({row['short_s'] or '–'}, {row['long_s'] or '–'}) s",
    )
    return ", ".join(parts)
