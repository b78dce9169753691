"""Random moored bodies in random weather: whether a run is what its tolerance says, and what it costs.

    python tests/bench/moored_in_time.py [--studies 200] [--seed 1] [--minutes 10] [--only 441 567]

Bodies: the series box in 12 and in 20 m of water, the buoy in 30 m, each solved once.  Moorings: 3 to 12 uniform lines,
anchored all round or to one side, from slack to a pretension of a tenth of the body's weight, weight 50 to 6 000 N/m,
EA 10⁷ to 10⁹ N, one in twenty inextensible.  Weather: Hs 0 to 6 m (as depth and steepness allow), Tp 4 to 20 s, any
direction, long- or short-crested, wind 0 to 50 m/s with or without gusts, current 0 to 2 m/s; one in five loses a line.

Every study is run to its tolerance with an estimate of the error, and again to a thousandth of the tolerance, beyond
all runs that the estimate is made of.  Counted are refusals with their reasons, numbers that are not finite, estimates
within a factor of three, errors beyond the tolerance, and needless warnings.  Motions that differ by more than a tenth
of their deviation even so are chance; the program has to say both, errors and chance.  On the verge of chance an error
told within a factor of three is told.
"""

import argparse
import sys
import tempfile
import time
import warnings
from dataclasses import replace
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem.database import open_database
from hakobune.mooring.environment.gusts import davenport
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.system.moored_body import Leg, leg_at_tension, moored_body
from hakobune.mooring.lines.system.parts import LineSystemError, LineType, UniformLine
from hakobune.mooring.motion.simulation import SimulationError, moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Current, ExposedBox, Wind
from hakobune.pipelines.cli import main

BODIES = {
    "box 12 m": "box --length 100 --beam 50 --draft 10 --depth 12 --gyration 15.55,29.44,32.28 --omega 0.12:2:50",
    "box 20 m": "box --length 100 --beam 50 --draft 10 --depth 20 --gyration 15.55,29.44,32.28 --omega 0.12:2:50",
    "buoy 30 m": "buoy --radius 10 --draft 10 --depth 30 --gyration 6,6,7 --center-of-gravity 0,0,-6 --omega 0.12:2:50",
}
HULLS = {"box": ExposedBox(100.0, 50.0, 10.0, 10.0), "buoy": None}
EXACT = 1e-3  # of the tolerance, that of the run that errors are told by
NOTHING = 1e-9  # m, rad: a motion that is none


def databases(folder):
    """{name: database} of BODIES, solved into a folder"""
    found = {}
    for name, words in BODIES.items():
        path = Path(folder) / f"{name.replace(' ', '_')}.h5"
        if not path.exists():
            assert main([*words.split(), "--heading", "0:90:4", "--output", str(path)]) == 0
        found[name] = open_database(path)
    return found


def random_system(rng, db, half_length, half_beam):
    """A System of random lines round the body; raises LineError or LineSystemError where one cannot hang"""
    count, depth = int(rng.integers(3, 13)), db.water_depth
    weight, stiffness = 10 ** rng.uniform(1.7, 3.8), 10 ** rng.uniform(7, 9) if rng.random() > 0.05 else np.inf
    body_weight = db.density * db.gravity * db.displaced_volume
    tension = body_weight * 10 ** rng.uniform(-4, -1) / count
    length = depth * rng.uniform(3, 20)
    kind = LineType("line", weight, stiffness, breaking_load=10 ** rng.uniform(6, 7.5))
    round_ = np.linspace(0, 2 * np.pi, count, endpoint=False) + rng.uniform(0, 2 * np.pi)
    if rng.random() < 0.2:
        round_ = rng.uniform(0, np.pi, count)
    legs = []
    for i, angle in enumerate(round_):
        fairlead = (half_length * np.sign(np.cos(angle)), half_beam * np.sign(np.sin(angle)), rng.uniform(-2, 2))
        line = UniformLine(f"{i}", kind, length, "", "", bed_friction=rng.choice([0.0, 0.6]))
        if rng.random() < 0.8:
            legs.append(leg_at_tension(line, fairlead, angle, depth, tension))
        else:  # slack: anchored close by
            away = 0.9 * length * np.array([np.cos(angle), np.sin(angle)])
            legs.append(Leg(line, (fairlead[0] + away[0], fairlead[1] + away[1], -depth), fairlead))
    return moored_body(legs, depth, db.rotation_center, db.density, db.gravity)


def random_weather(rng, depth, hull):
    period = rng.uniform(4, 20)
    height = min(rng.uniform(0, 6), 0.5 * depth, 0.05 * 1.56 * period**2) * (rng.random() > 0.1)
    direction, spreading = rng.uniform(0, 2 * np.pi), rng.choice([None, CosinePower(4.0)])
    seas = (Sea(jonswap(height, peak_period=period), direction, spreading),) if height > 0.01 else ()
    if hull is None:
        return Weather(seas)
    wind = Wind(rng.uniform(2, 50), rng.uniform(0, 2 * np.pi)) if rng.random() < 0.6 else None
    gusts = davenport(wind.speed, 0.003) if wind and rng.random() < 0.5 else None
    current = Current(rng.uniform(0, 2), rng.uniform(0, 2 * np.pi)) if rng.random() < 0.6 else None
    return Weather(seas, None, wind, gusts, current)


def one_study(rng, name, db, memory, duration):
    """(verdict, run or None, its error (6,) or None, seconds)"""
    box = name.startswith("box")
    system = random_system(rng, db, *((50.0, 25.0) if box else (7.0, 7.0)))
    hull = HULLS["box" if box else "buoy"]
    body = moored(db, system, hull, memory=memory)
    weather = random_weather(rng, db.water_depth, hull)
    lost = ((system.line_names[0], duration / 3),) if rng.random() < 0.2 else ()
    settings = Settings(duration, 100.0, lines_lost=lost, estimate_error=True, tolerance=10 ** rng.uniform(-4, -2))
    started = time.process_time()
    run = simulate(body, weather, settings, seed=int(rng.integers(1000)))
    seconds = time.process_time() - started
    finer = replace(settings, tolerance=EXACT * settings.tolerance, estimate_error=False)
    exact = simulate(body, weather, finer, seed=run.seed)
    late = run.time >= 0
    error = np.sqrt(np.mean((run.motion - exact.motion)[late] ** 2, axis=0))
    if not (np.isfinite(run.motion).all() and np.isfinite(run.tension).all()):
        return "not finite", run, error, seconds
    spread = run.motion[late].std(axis=0)
    share = np.where(spread > NOTHING, error / np.maximum(spread, NOTHING), 0.0)
    if any("forgets" in text for text in run.findings):
        return "chance, said", run, error, seconds
    said = any("give a smaller one" in text for text in run.findings)
    unforeseen = (share > 0.1) & (error > 3 * run.estimated_error)
    if unforeseen.any() or (share.max() > 0.1 and not said):
        return "CHANCE, NOT SAID", run, error, seconds
    if share.max() <= settings.tolerance:
        return ("within, warned" if said else "within"), run, error, seconds
    return ("beyond, said" if said else "BEYOND TOLERANCE, NOT SAID"), run, error, seconds


def campaign(numbers, seed, minutes, folder):
    """{verdict: count}, ratios of estimated to true error, seconds and reasons of refusals

    of the studies of a seed whose numbers are given
    """
    rng, found = np.random.default_rng(seed), databases(folder)
    memories = {name: moored(db).memory for name, db in found.items()}
    verdicts, ratios, seconds, reasons = {}, [], [], {}
    names = [list(found)[int(rng.integers(len(found)))] for _ in range(max(numbers) + 1)]
    for number in numbers:
        name = names[number]
        own = np.random.default_rng([seed, number])
        try:
            verdict, run, error, took = one_study(own, name, found[name], memories[name], 60.0 * minutes)
            seconds.append(took)
            if verdict in ("within", "within, warned", "beyond, said", "BEYOND TOLERANCE, NOT SAID"):
                moving = run.motion[run.time >= 0].std(axis=0) > NOTHING
                ratios += list((run.estimated_error / np.maximum(error, 1e-300))[moving])
        except (SimulationError, LineError, LineSystemError, ValueError) as refusal:
            verdict = "refused"
            reason = str(refusal).split(": ", 1)[-1].split(", line")[0][:110]
            reasons[reason] = reasons.get(reason, 0) + 1
        if verdict.isupper() or verdict == "not finite":
            off = np.max(error / np.maximum(run.motion[run.time >= 0].std(axis=0), NOTHING))
            print(f"study {number} of seed {seed}, {name}: {verdict}, {off:.2g} of a deviation", flush=True)
        verdicts[verdict] = verdicts.get(verdict, 0) + 1
    return verdicts, np.array(ratios), np.array(seconds), reasons


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--studies", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, nargs="+", default=None, help="numbers of studies, in place of --studies")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--folder", default=None, help="where the databases are kept; a temporary one if not given")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as temporary:
        numbers, folder = given.only or range(given.studies), given.folder or temporary
        counts, ratios, seconds, reasons = campaign(numbers, given.seed, given.minutes, folder)
    print(counts)
    within = np.mean((ratios > 1 / 3) & (ratios < 3)) if len(ratios) else np.nan
    print(f"estimated errors within a factor of three: {100 * within:.1f} % of {len(ratios)} motions")
    print(
        f"seconds of processor time a study with its estimate: median {np.median(seconds):.2f}, mean "
        f"{seconds.mean():.2f}, largest {seconds.max():.2f}"
    )
    for reason, count in sorted(reasons.items(), key=lambda item: -item[1]):
        print(f"{count:5d} refused: {reason}")
