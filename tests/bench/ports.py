"""Ships at their berths in long-period waves beside Shiraishi et al.: N port (Table 2), T port (Table 1).

    python tests/bench/ports.py [--hours 3]

Assumed, as the paper's ropes, waves, layout and displacements are lost: the berth of simulate_n_port.toml for both
ships, scaled to their lengths; long waves of 0.15 m (N) and 0.3 m (T) about 70 s, ISSC.  Methods of the paper: memory
(2; its 1 differs by 2 %), coefficients of the significant wave period, 16.6 s (3), and of the natural period (4).
"""

import argparse
import copy
import sys
import tempfile
import tomllib
import warnings
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[2])]
from hakobune import pipelines
from hakobune.bem.database import open_database
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.statistics import windows
from hakobune.mooring.studies.natural_periods import periods_at_berth
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.simulate.study import damping, plan_of, quadratic
from hakobune.pipelines.solve import run as solving

SCENES = Path(pipelines.__file__).parent / "scenes"
N_PORT = {"measured": (1.46, 57.6), "initial": (2.49, 97.7), "hardened": (1.62, 55.3)}  # m, s
T_PORT = "printed, 7 to 8 h, m: measured 6.33; pretension: method 2 5.97, 3 4.38, 4 4.38; none: 7.87, 6.67, 6.65"
T_SHIP = {"length": 215.0, "beam": 32.3, "draft": 7.28}
HARDENING, SIGNIFICANT, SEEDS = 3.12, 16.6, (1, 2, 3)


class Port:
    """A ship of the N port scene, or of other sizes, at the berth of simulate_n_port.toml"""

    def __init__(self, folder, name, **sizes):
        raw = tomllib.loads((SCENES / "ship_n_port.toml").read_text())
        raw["bodies"][0] |= sizes
        path = Path(folder) / f"{name}.h5"
        solving.solve(make_scene(raw), path)
        self.db, self.memory, body = open_database(path), None, raw["bodies"][0]
        self.raw = tomllib.loads((SCENES / "simulate_n_port.toml").read_text())
        along, across = body["length"] / 231.0, 0.5 * (body["beam"] - 43.0)
        for place in [*(f["position"] for f in self.raw["fender"]),
                      *(r[key] for r in self.raw["rope"] for key in ("fairlead", "bollard"))]:  # fmt: skip
            place[0], place[1] = along * place[0], place[1] + across

    def run(self, change=lambda raw: None, hours=3.0):
        """Natural period s, significant amplitude m and period s of surge, over SEEDS"""
        raw = copy.deepcopy(self.raw)
        raw["simulation"]["duration_hours"] = hours
        change(raw)
        study = make_study(raw)
        plan, hull = plan_of(study, self.db.reader.omega), study.hull_of(self.db.dimensions)
        held = damping(study, self.db.reader.floating()), quadratic(study)
        berth = study.berth(hull, self.db.rotation_center)
        body = moored(self.db, None, hull, memory=self.memory, damping=held[0], quadratic=held[1], berth=berth)
        self.memory, found = body.memory, []
        for seed in SEEDS:
            run = simulate(body, plan.weather, plan.settings, seed)
            late = run.time >= 0
            one = windows(run.motion[late], plan.settings.step, 3600.0 * hours - 1)
            found.append((one.amplitude[0, 0], one.period[0, 0]))
        return periods_at_berth(body)[0], *np.mean(found, axis=0)


def ropes(**values):
    """A change of every rope"""
    return lambda raw: [rope.update(values) for rope in raw["rope"]]


def method(number, natural):
    """A change to a method of the paper; natural : s"""
    period = {3: SIGNIFICANT, 4: natural}.get(number)
    words = {} if period is None else {"memory": "constant", "constant_period": float(period)}
    return lambda raw: raw["simulation"].update(words)


def both(*changes):
    return lambda raw: [change(raw) for change in changes]


def n_port(folder, hours):
    port = Port(folder, "n")
    found = {name: port.run(ropes(hardening=h), hours) for name, h in (("initial", 1.0), ("hardened", HARDENING))}
    for name, (natural, amplitude, period) in found.items():
        printed = N_PORT[name]
        print(f"N port, {name} ropes: natural period {natural:.1f} s; surge {amplitude:.2f} m, {period:.1f} s; "
              f"printed {printed[0]:.2f} m, {printed[1]:.1f} s")  # fmt: skip
    (first, _, slow), (second, _, fast) = found["initial"], found["hardened"]
    print(f"N port, ratio of natural periods {first / second:.3f}, of significant periods {slow / fast:.3f}; printed "
          f"{97.7 / 55.3:.3f}; measured {N_PORT['measured'][0]:.2f} m, {N_PORT['measured'][1]:.1f} s")  # fmt: skip
    for h in (1.0, 2.0, 5.0):
        for pull in (0.0, 50.0, 100.0):
            natural, amplitude, period = port.run(ropes(hardening=h, pretension_kN=pull), hours)
            print(f"N port, hardening {h:g}, pretension {pull:g} kN: natural {natural:.1f} s, {amplitude:.2f} m, "
                  f"{period:.1f} s")  # fmt: skip


def t_port(folder, hours):
    port = Port(folder, "t", **T_SHIP)
    print(f"T port, {T_PORT}")
    for pull in (50.0, 0.0):
        natural = None
        for number in (2, 3, 4):
            change = both(
                ropes(pretension_kN=pull), method(number, natural), lambda raw: raw["waves"].update(height=0.3)
            )
            found, amplitude, period = port.run(change, hours)
            natural = found
            print(f"T port, pretension {pull:g} kN, method {number}: {amplitude:.2f} m, {period:.1f} s "
                  f"(natural {found:.1f} s)")  # fmt: skip


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hours", type=float, default=3.0)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as place:
        n_port(place, given.hours)
        t_port(place, given.hours)
