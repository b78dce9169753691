"""Time and memory of one frequency against the number of panels, compressed and by full equations.

    python tests/bench/large.py [1000 2000 5000 10000 20000] [--length 1000 --beam 200] [--without-mirrors]
                                [--full-up-to 4000] [--plot growth.png] [--command 20000]

Box of 10 m draft in 20 m of water, six motions and one heading at 0.6 rad/s, with its lid where one is needed; every
row in a process of its own: seconds of processor and by the wall, the largest memory, what compression may change.  The
last line of each kind is the power of the number of panels that the last two rows follow.
With --command the command itself at two frequencies, with the estimated errors that it makes from a coarser mesh.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np

OMEGA, DRAFT, DEPTH = 0.6, 10.0, 20.0


def one(kind, panels, length, beam, mirrors):
    """Seconds and memory of a frequency, printed as JSON"""
    from hakobune.bem import DOFS
    from hakobune.bem.methods.panel_problem import PanelProblem
    from hakobune.bem.panels.compressed.one_frequency import CompressedRun
    from hakobune.bem.panels.one_frequency import PanelRun
    from hakobune.meshing.lid import lid
    from hakobune.meshing.shapes import box
    from hakobune.pipelines.validation.bench.peers.repeated import peak_memory

    runs = {"compressed": CompressedRun, "full": PanelRun}
    want = {"added_mass", "radiation_damping", "excitation_force"}
    few = box(100, 50, DRAFT, panels=600)
    small = PanelProblem(few, lid(few), depth=DEPTH).prepared()
    runs[kind](small, OMEGA, np.zeros(1), want, None, DOFS).result()  # which compiles
    mesh = box(length, beam, DRAFT, panels=panels)
    mesh = mesh if mirrors else mesh.whole()
    prepared = PanelProblem(mesh, lid(mesh), depth=DEPTH).prepared()
    processor, wall = time.process_time(), time.perf_counter()
    run = runs[kind](prepared, OMEGA, np.zeros(1), want, None, DOFS)
    run.result()
    row = {
        "panels": mesh.total,
        "nodes": len(run.geometry.elements.nodes),
        "processor": time.process_time() - processor,
        "wall": time.perf_counter() - wall,
        "memory": 1.048576e-3 * peak_memory(),
        "compression": getattr(run, "compression", 0.0),
    }
    print(json.dumps(row))


def measured(kind, panels, given):
    """`one` in a process of its own"""
    words = [
        sys.executable,
        __file__,
        "--one",
        kind,
        str(panels),
        "--length",
        str(given.length),
        "--beam",
        str(given.beam),
    ]
    done = subprocess.run(words + ["--without-mirrors"] * given.without_mirrors, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr.strip()[-500:])
    return json.loads(done.stdout.splitlines()[-1])


def growth(given):
    """{kind: rows}, printed as they come"""
    found = {"compressed": [], "full": []}
    print(f"{'':12}{'panels':>8}{'nodes':>9}{'processor s':>13}{'wall s':>8}{'GB':>7}{'compression':>13}")
    for kind, rows in found.items():
        for panels in given.panels:
            if kind == "compressed" or panels <= given.full_up_to:
                row = measured(kind, panels, given)
                rows.append(row)
                print(
                    f"{kind:12}{row['panels']:8}{row['nodes']:9}{row['processor']:13.1f}{row['wall']:8.1f}"
                    f"{row['memory']:7.2f}{row['compression']:13.1e}",
                    flush=True,
                )
        if len(rows) > 1:
            print(f"{kind:12}" + ", ".join(f"{name} ~ n^{power(rows, name):.2f}" for name in ("processor", "memory")))
    return found


def power(rows, name):
    """Power of the number of panels between the last two rows"""
    (a, b), (m, n) = ([row[key] for row in rows[-2:]] for key in (name, "panels"))
    return np.log(b / a) / np.log(n / m)


def draw(found, path):
    """Both kinds over the panels, time on the left and memory on the right, with n log n and n³ through a row"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 4), layout="constrained")
    for axes, name, unit in zip(figure.subplots(1, 2), ("processor", "memory"), ("s of processor", "GB"), strict=True):
        for kind, rows in found.items():
            axes.loglog([r["panels"] for r in rows], [r[name] for r in rows], "o-", label=kind)
        rows = found["compressed"]
        n = np.array([r["panels"] for r in rows], float)
        like = n * np.log(n)
        axes.loglog(n, like * rows[-1][name] / like[-1], "k--", linewidth=0.8, label="n log n")
        axes.set(xlabel="panels", ylabel=f"{unit}, one frequency")
        axes.grid(which="both", alpha=0.3)
        axes.legend()
    figure.savefig(path, dpi=120)


def command(panels, length, beam):
    """The command at two frequencies, beside what it says before it starts"""
    from rich.console import Console

    from hakobune.pipelines.common.progress import duration
    from hakobune.pipelines.scene.scene import make_scene
    from hakobune.pipelines.solve.run import solve
    from hakobune.pipelines.validation.bench.peers.repeated import peak_memory

    scene = make_scene(
        {
            "water": {"depth": DEPTH},
            "bodies": [{"shape": "box", "length": length, "beam": beam, "draft": DRAFT}],
            "waves": {"omegas": [0.3, OMEGA], "headings_deg": [45.0]},
            "method": "panel",
            "panels": panels,
            "want": ["radiation", "excitation_force"],
        }
    )
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        outcome = solve(scene, Path(folder) / "box.h5", console=Console())
        print(f"took {duration(time.perf_counter() - start)} in all, {1.048576e-3 * peak_memory():.1f} GB at most")
    return outcome.exit_status


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("panels", type=int, nargs="*", default=[1000, 2000, 5000, 10_000, 20_000])
    parser.add_argument("--length", type=float, default=1000.0)
    parser.add_argument("--beam", type=float, default=200.0)
    parser.add_argument("--without-mirrors", action="store_true")
    parser.add_argument("--full-up-to", type=int, default=4000)
    parser.add_argument("--plot")
    parser.add_argument("--command", type=int)
    parser.add_argument("--one", nargs=2, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        one(given.one[0], int(given.one[1]), given.length, given.beam, not given.without_mirrors)
        return 0
    if given.command:
        return command(given.command, given.length, given.beam)
    found = growth(given)
    if given.plot:
        draw(found, given.plot)
    return 0


if __name__ == "__main__":
    sys.exit(main())
