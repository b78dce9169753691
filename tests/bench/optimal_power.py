"""The largest power of a buoy in heave, by WecOptTool from our export, and by theory from the same numbers.

    python tests/bench/optimal_power.py --peer PYTHON

PYTHON has wecopttool (3.3).  In a regular wave of amplitude a the optimum without limits is |X a|² / 8B (Evans 1976).
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from hakobune.pipelines.cli import main

BUOY = "--radius 2 --draft 2.5 --depth inf --omega 0.3:3.0:10 --heading 0 --gyration 1,1,1"
PEER = """
import sys, warnings
import numpy as np
warnings.simplefilter("ignore")
import wecopttool as wot
data = wot.read_netcdf(sys.argv[1]).sel(radiating_dof=["Heave"], influenced_dof=["Heave"])
f, n, a = float(data.omega[0]) / 2 / np.pi, len(data.omega), 0.5
pto = wot.pto.PTO(1, np.eye(1), None, None, None, ["Heave"])
wec = wot.WEC.from_bem(data, f_add={"pto": pto.force_on_wec})
waves = wot.waves.regular_wave(f, n, 4 * f, a, 0.0, 0)
found = wec.solve(waves, pto.average_power, 2 * n, scale_x_opt=0.01, scale_obj=0.1, optim_options={"maxiter": 300})
one = data.sel(omega=float(data.omega[3]))
X, B = complex(one.excitation_force.values.ravel()[0]), float(one.radiation_damping.values.ravel()[0])
print(-found[0].fun, abs(a * X) ** 2 / 8 / B)
"""


def campaign(python):
    with tempfile.TemporaryDirectory() as name:
        buoy = Path(name) / "buoy.h5"
        if main(["buoy", *BUOY.split(), "--output", str(buoy)]) or main(["export", str(buoy), "--to", "capytaine"]):
            return 1
        words = [python, "-c", PEER, str(buoy.with_suffix(".nc"))]
        done = subprocess.run(words, capture_output=True, text=True, check=True)
        power, theory = map(float, done.stdout.split()[-2:])
        print(f"WecOptTool {power:.6g} W, theory {theory:.6g} W, {power / theory - 1:.1e}")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--peer", required=True)
    sys.exit(campaign(parser.parse_args().peer))
