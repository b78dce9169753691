"""Table 3.7.5.2 of the SR179 report (1982) again: floaters A and B between dolphins, in time.

The report gives neither the curve nor the number of its fenders, so these are assumed: three generic cell fenders of
the printed height, 0.5 m off the hull at still water, without friction, that unload with three quarters of their
loading curve; wind of 50 m/s with Davenport's gusts, K = 0.003; a current of 3 kn with the box tests' coefficients
of a depth of three drafts, as the printed static deflections are the same in every depth (here 0.147, 0.111, 0.090
and 0.309 m for 0.19, 0.11, 0.10 and 0.30); waves on the beam, those shorter than 3.9 s left out.  Surge, sway and
yaw are held by springs that are too soft to matter.

report       coefficients at the mean frequency of the waves, drift by half waves; the printed period is the mean one of
             the formula of section 3.7.1.2, T₀₁ = T̄/1.1
significant  the same, the printed period taken for the significant one, T₀₁ = 0.81 T₁/₃
full         memory of the water, Newman's drift; T₀₁ = T̄/1.1

Y₀ is the mean of the body's displacement at the fenders less their clearance, the strain (Y₀ + 3.87 σ)/H.

σ depends on the waves more than on anything else. Gusts, drift and the frequency of the coefficients change σ by a few
per cent, the fender by ten per cent.  Printed heave and roll, on which fenders hardly act, are smaller than computed
here in every row; they correspond to waves of 0.64 to 0.86 times the printed mean period. This reading of the period
also explains σ.  If the return is 0.65 of the loading, as for the generic fender, the mean of B changes by a tenth
to a fifth, and two verdicts change.
"""

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np

from hakobune.mooring.dolphins.design_spectrum import LARGEST, TOTAL
from hakobune.mooring.environment.gusts import davenport
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import bretschneider, mitsuyasu_bretschneider
from hakobune.mooring.fenders.families import fender_of_family
from hakobune.mooring.motion.contacts import QuayFender, berth_of
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Wind
from hakobune.mooring.studies.steady_loads import with_coefficients

from ...common.units import KNOT
from ..beside import number, read_rows
from .single_point_cases import FLOATERS

PRINTED = Path(__file__).parent / "dolphin_printed.csv"
BEAM, FREEBOARD = 0.5 * np.pi, 10.0
WIND, CURRENT, SURFACE_DRAG = 50.0, 3.0, 0.003  # m/s, kn, K of Davenport
FENDERS, CLEARANCE, RETURN = 3, 0.5, 0.75  # number; m; reaction on the return over that of loading
CURRENT_DEPTH = 3.0  # drafts
SOFT = np.array([1e-3, 1e-6, 0.0, 0.0, 0.0, 1e-4])  # 1/s², squares of frequencies of the holding springs
BEYOND = 5e7  # N/m, a fender's overload stiffness
HOUR, SEEDS = 3600.0, (1, 2)
VARIANTS = {"report": ("constant", "half-waves"), "significant": ("constant", "half-waves"),
            "full": ("states", "newman")}  # fmt: skip


def simulated_rows(databases, wanted=None, variants=tuple(VARIANTS), duration=HOUR, seeds=SEEDS):
    """[{column: number or text}] of every row of the table in every variant, as in `row_of`

    databases : {(floater, depth): Database}; wanted : numbers of rows, all by default; duration : s of each run
    """
    out, bodies = [], {}
    for printed in read_rows(PRINTED):
        if wanted is not None and int(printed["no"]) not in wanted:
            continue
        at, height = (printed["floater"], float(printed["depth_m"])), float(printed["height_m"])
        if (*at, height) not in bodies:
            bodies[*at, height] = _held(databases[at], at[0], height)
        for variant in variants:
            weather = _weather(printed, variant)
            with warnings.catch_warnings(action="ignore"):  # waves that are left out
                runs = [simulate(bodies[*at, height], weather, _settings(variant, duration), seed) for seed in seeds]
            out.append(row_of(printed, variant, runs, bodies[*at, height]))
    return out


def _hull(floater):
    f = FLOATERS[floater]
    return ExposedBox(f.length, f.beam, f.draft, FREEBOARD)


def _held(db, floater, height):
    """`Moored` floater before three fenders of a height, m"""
    hull = _hull(floater)
    fender = fender_of_family("cell", height, overload=BEYOND)
    fender = replace(fender, unloading=fender.loading.scaled(1.0, RETURN))
    across, side = np.array([0.0, 1.0, 0.0]), 0.5 * hull.beam
    fenders = [
        QuayFender(f"F{i}", fender, np.array([x * hull.length, side + CLEARANCE, 0.0]), across, side)
        for i, x in enumerate(np.linspace(-0.25, 0.25, FENDERS))
    ]
    spring = np.diag(SOFT * np.diag(db.reader.floating().inertia))
    return moored(db, None, hull, spring=spring, berth=berth_of(fenders, (), db.rotation_center))


def _weather(printed, variant):
    floater = printed["floater"]
    height, period = float(printed["wave_m"]), float(printed["period_s"])
    if variant == "significant":
        spectrum = mitsuyasu_bretschneider(height, significant_period=period)
    else:
        spectrum = bretschneider(height, significant_period=period / 0.9)
    streams = Conditions(Wind(WIND, BEAM), Current(CURRENT * KNOT, BEAM, waves="still"))
    streams = with_coefficients(streams, _hull(floater), CURRENT_DEPTH * FLOATERS[floater].draft)
    gusts = davenport(WIND, SURFACE_DRAG)
    return Weather((Sea(spectrum, BEAM),), wind=streams.wind, gusts=gusts, current=streams.current)


def _settings(variant, duration):
    memory, drift = VARIANTS[variant]
    return Settings(duration, step=0.25, memory=memory, slow_drift=drift, wave_drift_damping=memory == "states")


def row_of(printed, variant, runs, body):
    """{column: number or text} of a row of the table in a variant

    strain is deflection over height; off_share : share of time without contact; sigma, heave, sway, roll : standard
    deviations at the fenders and of the motions; printed_… : printed values, halves of the report's significant
    amplitudes
    """
    value = {key: number(text) for key, text in printed.items() if key != "floater"}
    late = runs[0].time >= 0
    motion = np.array([run.motion[late] for run in runs])
    above = -float(body.reader.rotation_center[2])
    at = motion[..., 1] - above * motion[..., 3] - CLEARANCE  # yaw turns about the middle fender
    spread = np.sqrt(motion.var(axis=1).mean(axis=0))
    mean, sigma = float(at.mean()), float(np.sqrt(at.var(axis=1).mean()))
    strain = (mean + LARGEST * sigma) / value["height_m"]
    ours = {"mean_m": mean, "sigma_m": sigma, "strain": strain, "verdict": _verdict(strain),
            "heave_m": float(spread[2]), "sway_m": float(spread[1]), "roll_deg": float(np.degrees(spread[3])),
            "off_share": float((at < 0).mean())}  # fmt: skip
    halves = {f"printed_{key}": 0.5 * value[key] for key in ("heave_m", "sway_m", "roll_deg")}
    whole = {f"printed_{key}": value[key] for key in ("mean_m", "sigma_m", "strain")}
    given = {key: value[key] for key in ("depth_m", "height_m", "period_s", "wave_m")}
    name = {
        "run": f"{printed['no']} {variant}",
        "no": int(printed["no"]),
        "floater": printed["floater"],
        "variant": variant,
    }
    return name | given | ours | whole | {"printed_verdict": _verdict(value["strain"])} | halves


def _verdict(strain):
    return "stands" if strain <= TOTAL else "too much"


def statements(rows):
    """One line on each variant"""
    for variant in dict.fromkeys(r["variant"] for r in rows):
        own = [r for r in rows if r["variant"] == variant]
        near, means = (sum(abs(r[key] / r[f"printed_{key}"] - 1) <= 0.2 for r in own) for key in ("sigma_m", "mean_m"))
        same = sum(r["verdict"] == r["printed_verdict"] for r in own)
        rolls = np.array([r["roll_deg"] / r["printed_roll_deg"] for r in own])
        yield (
            f"{variant}: σ is within a fifth of the printed value in {near} of {len(own)} rows, the mean in {means}; "
            f"the verdict at 35 % is the same in {same}; roll is {rolls.min():.2f} to {rolls.max():.2f} times the "
            f"printed value"
        )
