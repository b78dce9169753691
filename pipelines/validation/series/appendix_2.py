"""`hakobune series appendix-2`: the tests of model M3B at a single point, computed and measured.

SR179 report (1982), appendix 2, digitised in appendix_2.csv: three chains, an intermediate buoy of 5.8 kg on two
hawsers, or a contact buoy at the bow.  Values that the report does not state are assumed: lines at ±60° and 180° of
the waves, 0.72 and 0.82 kgf in them at rest; nylon hawsers of 5 mm, T = 4 kN (ε/0.25)², 0.4 m apart at the bow;
chains made fast 0.05 m under water, hawsers 0.05 m over it, on a gauge on the deck of the buoy, so that their pull
tilts the buoy. By this tilt the buoy yields three times as far as the hawsers stretch. With a buoy that stays
upright, snap loads are two to three times the loads measured in waves alone.  Significant loads are means of the
highest third of the crests, as for tank records.

On the intermediate buoy, pitch is taken from the run, in which buoy and body are in one equation. With a contact
buoy, pitch is computed from the sea's spectrum: the buoyancy of 0.2 × 0.5 m hinged 2.061 m ahead is a spring between
the bow and the surface of the waves, and the free model pitches 1 to 2 % more than that; 8 to 10 % more than with a
spring against still water.  These are the two limits for a contact buoy. On an intermediate buoy the measured pitch
is 15 to 19 % larger. It is also larger than the pitch of the free model in any sea of that spectrum, although the
hawsers are too weak to lift the model.
"""

import warnings
from pathlib import Path

import numpy as np

from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.single_point.equilibria import equilibria
from hakobune.mooring.single_point.scope import highest_third

from ...common.units import KGF
from ...scene.scene import make_scene
from ...single_point.running import run
from ...single_point.study import make as point_of
from ...single_point.tables import make_study
from ..beside import chosen, database, number, one_by_one, read_rows, result

TABLE = Path(__file__).parent / "appendix_2.csv"
LENGTH, BEAM, DEPTH, PERIOD = 3.872, 1.936, 1.2, 2.19
PIVOT, BUOY_AREA = 2.061, 0.2 * 0.5  # m ahead of the middle, m²
DRAFTS = {"10": (0.194, 2.36, (0.348, 0.289, 0.364)), "20": (0.097, 2.63, (0.298, 0.318, 0.350))}
BUOY = {"mass": 0.0058, "diameter": 0.33, "height": 0.11, "hawser_z": 0.05}  # t, m; its deck floats at 0.042 m
DURATION = 360.0  # s
SEAS, LIFTED = np.linspace(1.6, 4.0, 13), 1.0  # s; kgf, of hawsers of 4 kgf that rise by 14°
MEASURED = ("pitch_deg", "hawser_kgf", "buoy_kgf", "short_s", "long_s")
SCALE, SAFETY, LARGEST_KGF = 26.0, 4.0, 1.5  # length scale; safety factor; kgf, largest line tension of the model
HAWSERS = {"hawser_kgf": "of a hawser at the bow", "buoy_kgf": "on the buoy"}
REPORT_CHAINS = {"2": 42, "3": 36, "R3S": 32}  # mm; R3S for the report's grade 4, which has no formula there


def make(folder, only=None, fresh=False):
    """The Result: significant amplitudes and tensions of each test, computed and measured"""
    rows = read_tests(only)
    wide = sorted({row["B_over_d"] for row in rows})
    solved = {one: database(make_scene(scene_of(one)), folder / f"M3B_Bd{one}.h5", fresh) for one in wide}
    found = [computed(row, solved[row["B_over_d"]]) for row in one_by_one(rows, lambda row: row["case"])]
    notes = (*summary(found), *ceilings(solved), *chains())
    return result("series appendix-2", "SR179 report (1982), appendix 2", {"test": found}, notes)


def read_tests(only=None):
    """Tests, as dictionaries of text, selected by names.  Raises StudyError."""
    return chosen({row["case"]: row for row in read_rows(TABLE)}, only)


def scene_of(wide):
    """Raw tables of the scene of the model with a B/d, "10" or "20" """
    draft, KG, gyration = DRAFTS[wide]
    body = {"shape": "box", "length": LENGTH, "beam": BEAM, "draft": draft,
            "center_of_gravity": [0.0, 0.0, (KG - 1) * draft],
            "gyration": [gyration[0] * BEAM, gyration[1] * LENGTH, gyration[2] * LENGTH]}  # fmt: skip
    return {
        "tolerance": 0.02,
        "want": ["radiation", "diffraction", "motions", "drift", "limits"],
        "water": {"depth": DEPTH, "density": 1000.0},
        "bodies": [body],
        "waves": {"periods": {"from": 0.85, "to": 9.0, "count": 26}, "headings_deg": [0, 22.5, 45, 67.5, 90]},
    }


def study_of(row, scheme=None, seed=1):
    """Nested dictionaries of the study of a test; seed : seed of its waves"""
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


def computed(row, db, seed=1):
    """{column: number or text} of a test, computed and measured; seed : seed of its waves

    pitch_deg : significant amplitude; hawser, buoy : kgf significant, of one at the bow, of both, massless by a buoy
    without mass; settled_s : time until the heading is within 1° of rest, s, nan if never; slews : whether slewing
    persists
    periods_s : periods s of the small motions, as text
    """
    study = make_study(study_of(row, seed=seed))
    point = point_of(study, db).point
    best = max(equilibria(point), key=lambda one: np.cos(one.heading))
    waves, contact = study.waves is not None, row["buoy"] == "contact"
    pitch = hawser = both = massless = np.nan
    with warnings.catch_warnings(action="ignore"):
        made = run(study, best, db)
        record = made.record
        late = record.time > record.time[-1] / 3  # the first third settles the heading
        if waves and contact:
            pitch = pitch_amplitude(db, study.waves.height)
        elif waves:
            pitch = 2 * float(np.degrees(record.wave[late, 4].std()))
            hawser = float(np.mean([highest_third(one) for one in record.hawser[late].T])) / KGF
            both = highest_third(record.hawser[late].sum(axis=1)) / KGF
            light = run(make_study(study_of(row, "two_scale", seed)), best, db).record
            massless = highest_third(light.hawser[light.time > light.time[-1] / 3].sum(axis=1)) / KGF
    outside = np.flatnonzero(np.degrees(np.abs(record.heading - best.heading)) > 1.0)
    last = int(outside[-1]) + 1 if len(outside) else 0
    settled = float(record.time[last]) if last < len(record.time) else np.nan
    roots = sorted((root for root in best.roots.imag if root > 1e-6), reverse=True)
    slews = bool(made.cycle.stays and not best.slewing.stable)  # a stable heading that wanders is driven by slow drift
    kept = {key: row[key] for key in ("case", "buoy", "B_over_d")}
    kept |= {key: float(row[key]) for key in ("height_cm", "current_cm_s", "heading_deg")}
    measured = {f"measured_{key}": number(row[key]) for key in MEASURED}
    ours = {"pitch_deg": pitch, "hawser_kgf": hawser, "buoy_kgf": both, "massless_buoy_kgf": massless,
            "settled_s": settled, "slews": slews,
            "periods": " ".join(f"{2 * np.pi / root:.0f}" for root in roots)}  # fmt: skip
    return kept | ours | measured


def pitch_amplitude(db, height, period=PERIOD, area=BUOY_AREA):
    """Significant pitch amplitude 2σ, degrees, with a contact buoy in head waves of an ISSC spectrum; area : area of
    the buoy, m²
    """
    lever, spring = np.array([0, 0, 1.0, 0, -PIVOT, 0]), db.density * db.gravity * area
    body, plane = db.reader.restrained(stiffness=spring * np.outer(lever, lever)), [0, 2, 4]
    omega = frequencies(body)
    A, B = body.coefficients(omega)
    s = -1j * omega[:, None, None]
    Z = s**2 * (body.inertia + A) + s * (B + body.damping) + body.stiffness
    k = wavenumber(omega, db.water_depth, db.gravity)
    lifted = spring * np.exp(-1j * k * PIVOT)[:, None] * lever  # moment of waves towards π
    force = body.forces(omega, [np.pi])[:, 0] + lifted
    X = np.abs(np.linalg.solve(Z[:, plane][:, :, plane], force[:, plane, None])[:, 2, 0])
    density = issc(height, mean_period=period).density(omega)
    return float(2 * np.degrees(np.sqrt(np.trapezoid(X**2 * density, omega))))


def summary(found):
    """Lines on all tests, computed and measured means"""
    for wide in ("10", "20"):
        for buoy in ("intermediate", "contact"):
            own = [one for one in found if (one["B_over_d"], one["buoy"]) == (wide, buoy)]
            pairs = _pairs(own, "pitch_deg", 2.0)
            if len(pairs):
                ours, measured = pairs.mean(axis=0)
                yield f"B/d {wide}, {buoy}: σ of pitch over σ of the waves {ours:.3f} °/cm, measured {measured:.3f}"
    for words, current in (("waves and current", True), ("waves alone", False)):
        own = [one for one in found if (one["current_cm_s"] > 0) == current]
        for column, place in HAWSERS.items():
            pairs = _pairs(own, column)
            if len(pairs):
                ours, measured = pairs.mean(axis=0)
                light = [
                    one["massless_buoy_kgf"] for one in own if np.isfinite(one[column] + one[f"measured_{column}"])
                ]
                without = f", {np.mean(light):.2f} without its mass" if column == "buoy_kgf" else ""
                yield f"{words}, {len(pairs)} tests: {ours:.2f} kgf {place}{without}, measured {measured:.2f}"
    late = [one for one in found if np.isfinite(one["settled_s"])]
    names = ", ".join(one["case"] for one in found if one["slews"]) or "none"
    yield f"slewing continues in {names} of {len(found)}; the heading comes to rest in {len(late)}"


def _pairs(found, column, per_height=None):
    """Computed and measured, where both are known; shape (n, 2); times a factor over the height where one is given"""
    both = [[one[column], one[f"measured_{column}"]] for one in found]
    sizes = [
        1.0 if per_height is None else per_height / one["height_cm"] if one["height_cm"] else np.nan for one in found
    ]
    pairs = np.reshape(both, (-1, 2)) * np.array(sizes)[:, None]
    return pairs[np.isfinite(pairs).all(axis=1)]


def ceilings(databases):
    """Lines on the largest pitch of the free model in an ISSC sea of any period, from {B/d: database}

    The pitch measured on the intermediate buoy lies above; the pulls of a hawser are too small to cause it.
    """
    for wide, db in databases.items():
        sigmas = [pitch_amplitude(db, 0.04, period, 0.0) / 2 for period in SEAS]
        righting = db.reader.stiffness[4, 4] * np.radians(1.0)
        moment = LIFTED * KGF * 0.5 * LENGTH / righting
        yield (
            f"B/d {wide}: the free model pitches by at most {max(sigmas):.3f} °/cm, σ over σ, in an ISSC sea of "
            f"any mean period from {SEAS[0]:.2g} to {SEAS[-1]:.2g} s; {LIFTED:g} kgf upwards at its bow turn it "
            f"by {moment:.2f}°"
        )


def chains():
    """Lines on the chain that the largest tension requires at full scale"""
    load = LARGEST_KGF * SCALE**3 / 1e3 * SAFETY
    for grade, printed in REPORT_CHAINS.items():
        d = next(d for d in range(10, 200) if _breaking(grade, d) >= load)
        yield (
            f"chain for {load:.1f} tonf ({LARGEST_KGF} kgf × {SCALE:g}³ × {SAFETY:g}), grade {grade}: {d} "
            f"mm computed; the report has {printed} mm, which breaks at {_breaking(grade, printed):.1f} tonf"
        )


def _breaking(grade, d):
    name = f"{grade} studlink {d} mm" if grade.startswith("R") else f"grade {grade} studlink {d} mm"
    return line_type(name).breaking_load / KGF / 1e3
