"""Eight lines on one body: time of forces with stiffness and of the equilibrium, beside MoorPy in the same run.

    python tests/bench/systems.py [--peer /path/to/python/with/moorpy]

Targets: 50 µs for forces with the 6×6 stiffness, 1 ms for an equilibrium.  Minimum of several runs.
"""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.bem import DOFS
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, Fairlead, LineType, MooredBody, UniformLine

DEPTH, LENGTH, WEIGHT, EA = 100.0, 595.0, 1000.0, 5e8
HEADINGS = [20, 60, 120, 160, 200, 240, 300, 340]
MASS, GM, WATERPLANE, G, RHO = 3e7, 2.0, 4000.0, 9.81, 1025.0
LOAD = [2e5, 1e5, 0.0, 0.0, 0.0, 2e6]
PEER = """
import contextlib, io, json, time
import numpy as np
import moorpy as mp
c = json.loads(input())
ms = mp.System(depth=c["depth"], rho=c["rho"], g=c["g"])
area = np.pi / 4 * 0.01
mass = c["weight"] / c["g"] + c["rho"] * area
ms.lineTypes["c"] = dict(name="c", d_vol=0.1, m=mass, w=c["weight"], EA=c["EA"], input_d=0.1, material="c")
hull = dict(m=c["mass"], v=c["mass"] / c["rho"], AWP=c["waterplane"], rM=np.array([0, 0, c["GM"]]))
ms.addBody(0, np.zeros(6), rCG=np.zeros(3), f6Ext=np.array(c["load"]), **hull)
for i, a in enumerate(np.radians(c["headings"])):
    ms.addPoint(1, [600 * np.cos(a), 600 * np.sin(a), -c["depth"]])
    ms.addPoint(1, [50 * np.cos(a), 20 * np.sin(a), -5.0])
    ms.bodyList[0].attachPoint(2 * i + 2, [50 * np.cos(a), 20 * np.sin(a), -5.0])
    ms.addLine(c["length"], "c")
    ms.pointList[2 * i].attachLine(i + 1, 0)
    ms.pointList[2 * i + 1].attachLine(i + 1, 1)
with contextlib.redirect_stdout(io.StringIO()):
    ms.initialize()
    b = ms.bodyList[0]
    times = []
    for _ in range(20):
        t = time.perf_counter()
        b.setPosition(np.zeros(6))
        K = b.getStiffnessA(lines_only=True)
        F = b.getForces(lines_only=True)
        times.append(time.perf_counter() - t)
    solves = []
    for _ in range(5):
        b.setPosition(np.zeros(6))
        t = time.perf_counter()
        ms.solveEquilibrium(tol=1e-6)
        solves.append(time.perf_counter() - t)
found = dict(K=K.tolist(), F=np.asarray(F).tolist(), position=b.r6.tolist())
print(json.dumps(dict(forces=min(times), rest=min(solves), **found)))
"""


def eight_lines():
    """The system that both solve"""
    kind, points, lines = LineType("chain", WEIGHT, EA), [], []
    for i, a in enumerate(np.radians(HEADINGS)):
        points.append(Anchor(f"A{i}", (600 * np.cos(a), 600 * np.sin(a), -DEPTH)))
        points.append(Fairlead(f"F{i}", "body", (50 * np.cos(a), 20 * np.sin(a), -5.0)))
        lines.append(UniformLine(f"L{i}", kind, LENGTH, f"A{i}", f"F{i}"))
    C = np.diag([0.0, 0.0, RHO * G * WATERPLANE, MASS * G * GM, MASS * G * GM, 0.0])
    return System(DEPTH, lines, points, (MooredBody("body", freedom=DOFS, hydrostatic_stiffness=C, load=LOAD),), RHO, G)


def least(action, runs):
    """s, the shortest of some runs"""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times)


def peer_results(python):
    """What MoorPy finds for the same system"""
    case = {
        "depth": DEPTH, "length": LENGTH, "weight": WEIGHT, "EA": EA, "headings": HEADINGS, "mass": MASS, "GM": GM,
        "waterplane": WATERPLANE, "g": G, "rho": RHO, "load": LOAD,
    }  # fmt: skip
    done = subprocess.run([python, "-c", PEER], input=json.dumps(case), capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{python} did not run MoorPy: {done.stderr.strip().splitlines()[-1]}")
    return json.loads(done.stdout.splitlines()[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peer", help="python of an environment with MoorPy")
    peer = parser.parse_args().peer
    system = eight_lines()
    state, load = rest(system), system.load()
    forces, solve = least(system.load, 3000), least(lambda: rest(system), 100)
    print(f"forces and 6x6 stiffness  {1e6 * forces:8.1f} µs   target 50")
    print(f"equilibrium               {1e3 * solve:8.3f} ms   target 1, {state.iterations} steps")
    print(f"left unbalanced           {np.abs(state.residual).max():8.1e} N of {state.tension.sum():.3g} N")
    if peer is None:
        return
    other = peer_results(peer)
    scale = np.sqrt(np.diag(load.stiffness))
    K = np.abs(np.array(other["K"]) - load.stiffness) / np.outer(scale, scale)
    print(f"MoorPy: forces and stiffness {1e6 * other['forces']:.0f} µs, equilibrium {1e3 * other['rest']:.1f} ms")
    print(f"    {other['forces'] / forces:.0f} and {other['rest'] / solve:.0f} times as long")
    force = np.abs(np.array(other["F"]) - load.force).max()
    place = np.abs(np.array(other["position"]) - state.position[0]).max()
    print(f"    largest difference: force {force:.2g} N, stiffness {K.max():.2g}, position {place:.2g} m or rad")


if __name__ == "__main__":
    main()
