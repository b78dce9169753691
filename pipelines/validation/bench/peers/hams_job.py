"""HAMS's side of the bench, by its wheel pyhams: a job on standard input, one line of JSON on standard output.

The job is the same as in `capytaine_job.py`, with symmetry "y" or "", since HAMS takes one mirror plane only.
HAMS reads and writes files and solves all frequencies in one call. A child process solves the first frequency alone,
another solves all of them, and the difference is the time of the other frequencies.
"""

import os
import tempfile
import time
from pathlib import Path

import numpy as np
import pyhams.pyhams as hams
from repeated import answer, job


def write_mesh(path, part, symmetry):
    """A .pnl file"""
    points, panels = part["vertices"], part["faces"]
    mirrored = "0 1" if symmetry == "y" else "0 0"
    lines = ["mesh", "", "# panels, nodes, x and y symmetry", f"{len(panels)} {len(points)} {mirrored}", "", "# nodes"]
    lines += [f"{i + 1} {x:.9f} {y:.9f} {z:.9f}" for i, (x, y, z) in enumerate(points)]
    lines += ["# end", "", "# panels"]
    for i, panel in enumerate(panels):
        corners = [n + 1 for k, n in enumerate(panel) if n != panel[k - 1]]
        lines.append(" ".join(map(str, (i + 1, len(corners), *corners))))
    path.write_text("\n".join([*lines, "# end", ""]), encoding="ascii")


def write_project(folder, job, omegas):
    hams.create_hams_dirs(folder)
    hams.write_hydrostatic_file(folder)
    hams.write_control_file(
        folder,
        waterDepth=job["depth"],
        incFLim=0,
        iFType=3,
        oFType=3,
        numFreqs=len(omegas),
        freqList=omegas,
        numHeadings=1,
        headingList=[float(np.degrees(job["heading"]))],
        irr=int(job["lid"] is not None),
        numThreads=int(os.environ.get("OMP_NUM_THREADS", "1")),
    )
    control = Path(folder, "Input", "ControlFile.in")  # pyhams writes a negative depth, which is deep water to HAMS
    control.write_text(control.read_text().replace("Waterdepth  -", "Waterdepth  "))
    write_mesh(Path(folder, "Input", "HullMesh.pnl"), job["hull"], job["symmetry"])
    if job["lid"]:
        write_mesh(Path(folder, "Input", "WaterplaneMesh.pnl"), job["lid"], job["symmetry"])


def in_a_child(folder):
    """Return (wall s, processor s, MB at most) of one call, from the start of its process; what it prints is dropped"""
    begun, child = time.time(), os.fork()
    if child == 0:
        with open(os.devnull, "w") as nowhere:
            os.dup2(nowhere.fileno(), 1)
        hams.run_hams(folder)
        os._exit(0)
    _, status, used = os.wait4(child, 0)
    if status:
        raise SystemExit(f"HAMS ended with status {status}")
    return time.time() - begun, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def read(folder, job):
    """A, B (n, 6, 6), X (n, 6) from the files in the manner of WAMIT: divided by ρ, ρω and ρg, exp(+iωt)"""
    found = Path(folder, "Output", "Wamit_format")
    A, B, omega = hams.read_wamit1(found / "Buoy.1")
    _, _, re, im, _, _ = hams.read_wamit3(found / "Buoy.3")
    A, B, X = (np.moveaxis(v, -1, 0) for v in (A, B, (re + 1j * im)[0]))
    rho, g = job["density"], job["gravity"]
    return rho * A, rho * omega[:, None, None] * B, rho * g * X.conj()


def main():
    asked = job()
    first, every = [], []
    with tempfile.TemporaryDirectory() as folder:
        for count in range(asked["passes"]):
            begun = time.time()
            for omegas, times in ((asked["omega"][:1], first), (asked["omega"], every)):
                write_project(folder, asked, omegas)
                times.append(in_a_child(folder))
                if count == 0 and times is first:
                    first_s = time.time() - asked["started"]
            if time.time() - begun > asked["seconds"]:
                break
        A, B, X = read(folder, asked)
    wall, cpu = (1e3 * (min(t[k] for t in every) - min(t[k] for t in first)) / (len(A) - 1) for k in (0, 1))
    times = {"first_s": first_s, "body_ms": float("nan"), "warm_ms": wall, "cpu_ms": cpu, "passes": len(every)}
    times["memory_mb"] = max(t[2] for t in every)
    answer({**times, "A": A.tolist(), "B": B.tolist(), "X": [X.real.tolist(), X.imag.tolist()], "version": "1.3.1"})


if __name__ == "__main__":
    main()
