"""Tensions of moving lines in a file of `hakobune simulate`, beside MoorDyn driven with the motion of their body.

    python tests/bench/run_by_moordyn.py RUN.h5 LINES.txt BODY PYTHON_WITH_MOORDYN [--from 60] [--step 0.005]

LINES.txt is the `lines_file` of the study, whose body 1 is coupled; its lines that end at the body, in the order of the
file, are those of the run.  Positions of the body between samples are a cubic spline.  MoorDyn's tension is that of the
last element, ours the pull at the fairlead, with half the weight of this element: on RM3's lines 0.38 % of the mean.

RM3 in the first 1000 s of WEC-Sim's example record (`import --uncoupled`), from 300 s on, rms of the difference without
means: 1.42, 1.29, 1.29 % of σ (12.61, 6.39, 6.39 kN); in regular waves of 2.5 m and 8 s 1.93, 2.06, 2.06 %.
"""

import argparse
import subprocess
import tempfile
from pathlib import Path

import h5py
import numpy as np
from scipy.interpolate import CubicSpline

from hakobune.mooring.formats.moordyn import read_moordyn
from hakobune.mooring.motion.simulation.realisation import poses_of

PEER = """
import sys
import moordyn, numpy as np
given = np.load(sys.argv[2])
place, speed, dt = given["place"], given["speed"], float(given["step"])
system = moordyn.Create(sys.argv[1])
moordyn.Init(system, place[0].tolist(), speed[0].tolist())
lines = [moordyn.GetLine(system, int(i)) for i in given["lines"]]
pulls = [[moordyn.GetLineFairTen(line) for line in lines]]
for i in range(1, len(place)):
    moordyn.Step(system, place[i - 1].tolist(), ((place[i] - place[i - 1]) / dt).tolist(), (i - 1) * dt, dt)
    pulls.append([moordyn.GetLineFairTen(line) for line in lines])
np.save(sys.argv[3], pulls)
"""


def course_of(path, body, step):
    """Times (n,) s of samples, tensions (n, lines) N, times (m,), poses and velocities (m, 6) of a body between them"""
    with h5py.File(path) as file:
        t, names = file["time"][:] - file["time"][0], file["dof"].asstr()[:].tolist()
        first = names.index(f"{body}__Surge")
        motion, pull = file["motion"][0, :, first : first + 6].astype(float), file["tension"][0].astype(float)
        center, heading = file.attrs["rotation_center"][first // 6], np.ravel(file.attrs["heading"])[first // 6]
    at_rest = np.array([[*center, 0.0, 0.0, heading]])
    spline, fine = CubicSpline(t, [poses_of(row, at_rest)[0] for row in motion]), np.arange(0.0, t[-1], step)
    return t, pull, fine, spline(fine), spline(fine, 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    for name in ("run", "lines", "body", "python"):
        parser.add_argument(name)
    parser.add_argument("--from", dest="begin", type=float, default=60.0, help="s, after MoorDyn's own start")
    parser.add_argument("--step", type=float, default=0.005, help="s, from one place given to MoorDyn to the next")
    given = parser.parse_args()
    file = read_moordyn(given.lines)
    borne = {point.id for point in file.points if point.attachment.lower().startswith("body")}
    ends = [row.id for row in file.lines if {row.a, row.b} & borne]
    t, ours, fine, place, speed = course_of(given.run, given.body, given.step)
    with tempfile.TemporaryDirectory() as folder:
        course, found = Path(folder) / "course.npz", Path(folder) / "pulls.npy"
        np.savez(course, place=place, speed=speed, step=given.step, lines=ends)
        told = subprocess.DEVNULL
        paths = str(Path(given.lines).resolve()), str(course), str(found)
        subprocess.run([given.python, "-c", PEER, *paths], check=True, stdout=told, cwd=folder)
        pulls = np.load(found)
    late = t >= given.begin
    for i, name in enumerate(ends):
        peer, own = np.interp(t, fine, pulls[:, i])[late], ours[late, i]
        off = 100 * np.std(own - peer) / np.std(peer)
        print(
            f"line {name}: MoorDyn {peer.mean() / 1e3:.2f} ± {peer.std() / 1e3:.2f}, up to {peer.max() / 1e3:.1f}; "
            f"ours {own.mean() / 1e3:.2f} ± {own.std() / 1e3:.2f}, up to {own.max() / 1e3:.1f} kN; rms without means "
            f"{off:.2f} % of σ"
        )


if __name__ == "__main__":
    main()
