"""Dirlik's rule and the narrow-band rule against rainflow, on tensions of simulated moorings.

    python tests/bench/fatigue_by_spectra.py [--hours 3] [--seeds 4] [--folder DIR]

The series box in 20 m of water on twelve lines as in `pipelines/scenes/simulate_chain_12.toml`, of its chain or of
taut polyester, from mild weather to a storm.  Moments are those of each record's own periodogram, so the rules see the
very energy that rainflow counts.  Both suppose a Gaussian tension: skewness and excess of the fourth moment say how far
it is from one.  Printed are the least and the largest ratio over the lines, for curves of exponent 3 and 4.
"""

import argparse
import sys
import tempfile
import tomllib
import warnings
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "bench")]

import h5py
import numpy as np
import tomli_w
from moored_in_time import databases
from scipy import stats

from hakobune.bem.database import open_database
from hakobune.mooring.criteria.fatigue import Curve, dirlik, miner, narrow_band, rainflow_cycles
from hakobune.pipelines.executors.choice import Here
from hakobune.pipelines.simulate.run import input_of, simulate

STATIC = {"dynamic_lines": "none", "qtf": "newman"}
TAUT = {"catalogue": "polyester 200 mm"}
WEATHER = {  # m/s of wind, knots of current, m and s of the waves
    "mild": (10.0, 0.5, 1.0, 7.0),
    "moderate": (20.0, 1.0, 2.0, 8.0),
    "heavy": (35.0, 2.0, 3.0, 9.0),
    "storm": (50.0, 3.0, 4.5, 10.0),
}
RUNS = (("chain", "mild"), ("chain", "moderate"), ("chain", "storm"), ("taut", "moderate"), ("taut", "heavy"))


def study(lines, weather, hours, seeds):
    """Raw tables of a simulation"""
    raw = tomllib.loads((ROOT / "pipelines" / "scenes" / "simulate_chain_12.toml").read_text(encoding="utf-8"))
    wind, current, height, period = WEATHER[weather]
    raw["wind"]["speed"], raw["current"]["speed_knots"] = wind, current
    raw["waves"] |= {"height": height, "period": period}
    raw["simulation"] = {"duration_hours": hours, "seeds": seeds, "memory": "constant"} | STATIC
    if lines == "taut":
        raw["types"] = {"rope": TAUT}
        raw["spreads"] = [{**one, "type": "rope", "pretension_tonf": 150.0} for one in raw["spreads"]]
    return raw


def ratios(records, step, curve):
    """Dirlik and narrow band over rainflow of a line; records : (runs, t) of tension over breaking load"""
    count = records.shape[1]
    omega = 2 * np.pi * np.fft.rfftfreq(count, step)
    found = np.zeros(3)
    for record in records:
        energy = 2 * np.abs(np.fft.rfft(record - record.mean())) ** 2 / count**2
        moments = [np.sum(omega**n * energy) for n in (0, 1, 2, 4)]
        counted = miner(rainflow_cycles(record), curve, 0.0, 1.0)[0] / (count * step)
        found += dirlik(moments, curve, 1.0), narrow_band(moments, curve, 1.0), counted
    return found[:2] / found[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hours", type=float, default=3.0)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--folder", type=Path)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.folder or Path(temporary)
        database = Path(databases(folder)["box 20 m"].path)
        print("lines, weather      mean   skewness    excess     exponent  Dirlik        narrow band")
        for lines, weather in RUNS:
            path = folder / f"{lines}_{weather}.toml"
            path.write_text(tomli_w.dumps(study(lines, weather, given.hours, given.seeds)), encoding="utf-8")
            simulate(input_of(path), open_database(database), path.with_suffix(".h5"), None, Here())
            with h5py.File(path.with_suffix(".h5")) as file:
                share = file["tension"][()].astype(float) / file.attrs["breaking_load"]
                step = float(np.diff(file["time"][:2])[0])
            flat = share.reshape(-1, share.shape[-1])
            skew, excess = np.abs(stats.skew(flat)).max(), stats.kurtosis(flat).max()
            for exponent in (3.0, 4.0):
                curve = Curve("straight", "share", exponent, 1.0)
                (low, narrow), (high, wide) = (
                    pick([ratios(share[..., line], step, curve) for line in range(share.shape[-1])], axis=0)
                    for pick in (np.min, np.max)
                )
                print(
                    f"{lines:6} {weather:10} {flat.mean():6.3f} {skew:10.2f} {excess:10.2f} {exponent:10g}  "
                    f"{low:.2f} to {high:.2f}  {narrow:.2f} to {wide:.2f}",
                    flush=True,
                )


if __name__ == "__main__":
    main()
