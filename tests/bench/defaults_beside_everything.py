"""What `hakobune simulate` takes where a study says nothing, beside everything: memory, all lines moving, all pairs.

    python tests/bench/defaults_beside_everything.py FOLDER [SEEDS] [SECONDS] [NAME …]

Three pontoons in shallow water and floater A of `hakobune new simulation`, by default ten seeds of 1 200 s.  With
"everything" are meant dynamic_lines = "all" and qtf = "full": the pairs that reach the waves, with the forcing of the
surface, as `hakobune qtf --level full` stores them in a second database (half a minute to five minutes a body).
Printed are σ of slow surge, sway and yaw over the seeds and the largest tension of all, both beside each other; what
either run took of pairs and lines; and the first line of the answer by default.  A motion of less than MINOR of the
largest, yaw at the ends of the hull, is zero by symmetry and not judged.  In the end each body is within TARGET, or
told by a first line that begins with "left out", or missed.  Databases and runs stay in the folder and are not made
again.
"""

import re
import shutil
import sys
import tomllib
from pathlib import Path

import numpy as np
import tomli_w

from hakobune.pipelines.cli import main
from hakobune.pipelines.simulate.file import LEFT_OUT, STATISTICS, opened, told, whole_rows

SCENES = Path(__file__).parents[2] / "pipelines" / "scenes"
TARGET, MINOR = 0.2, 0.01  # of what everything gives; of the largest slow motion
PAIRS = {True: "0.4:3.0:53", False: "0.3:2.1:37"}  # rad/s, of pontoons and of floater A, whose band ends at 2.2
DRAG = {"angles_deg": [0, 30, 60, 90], "x": [0.8, 0.7, 0.4, 0.0], "y": [0.0, 0.6, 1.04, 1.2],
        "lever": [0.0, 0.05, 0.03, 0.0]}  # fmt: skip
PONTOONS = {  # length, beam, draft, depth m; chain mm, its length m, pretension kN; waves m, s, towards °; swell m, s
    "pontoon 90 x 30 in 14 m": (90, 30, 2.5, 14, 76, 160, 150, 2.2, 5.84, 90, (0.8, 10.3)),
    "pontoon 60 x 20 in 10 m": (60, 20, 2.0, 10, 60, 120, 100, 1.2, 5.0, 60, None),
    "pontoon 120 x 30 in 20 m": (120, 30, 4.0, 20, 84, 220, 250, 2.0, 7.0, 120, None),
}


def pontoon(length, beam, draft, depth, chain, line, pull, height, period, towards, swell):
    """Raw tables of a scene and of a study"""
    scene = {
        "tolerance": 0.01,
        "water": {"depth": float(depth)},
        "bodies": [{"shape": "box", "length": float(length), "beam": float(beam), "draft": draft,
                    "center_of_gravity": [0.0, 0.0, 0.5], "gyration": [0.32 * beam, 0.29 * length, 0.3 * length]}],
        "waves": {"band": {"from": 0.05, "to": 3.2}, "headings_deg": {"from": 0, "to": 180, "count": 13}},
    }  # fmt: skip
    study = {
        "allowable": 0.5,
        "water": {"depth": float(depth)},
        "hull": {"freeboard": 1.5},
        "types": {"chain": {"catalogue": f"R3 studless {chain} mm", "bed_friction": 0.6}},
        "spreads": [{"type": "chain", "length": float(line), "corner_headings_deg": [30, 60], "pretension_kN": pull}],
        "wind": {"speed": 20.0, "direction_deg": towards, "gusts": "npd"},
        "current": {"speed": 0.5, "direction_deg": towards, "coefficients": DRAG},
        "waves": {"height": height, "period": period, "direction_deg": towards, "spectrum": "jonswap"},
        "simulation": {},
    }
    if swell:
        sea = {"height": swell[0], "period": swell[1], "direction_deg": towards, "spectrum": "jonswap", "gamma": 5.0}
        study["simulation"]["sea"] = [sea]
    return scene, study


def floater():
    """Raw tables of the scene and the study of `hakobune new simulation`"""
    read = lambda name: tomllib.loads((SCENES / name).read_text(encoding="utf-8"))  # noqa: E731
    scene, study = read("series_box_20m.toml"), read("simulate_chain_12.toml")
    study["simulation"] = {}
    return scene, study


def run(folder, name, study, database):
    """Open file of a simulation, made if it is not there"""
    path = folder / f"{name}.h5"
    (folder / f"{name}.toml").write_text(tomli_w.dumps(study), encoding="utf-8")
    words = ["simulate", str(folder / f"{name}.toml"), "--database", str(database), "--output", str(path)]
    assert main(words) in (0, 1)  # 1 where lines part
    return path


def numbers(path):
    """σ of slow surge, sway (m), yaw (°) over the seeds, largest tension kN; what the file tells; what the run took"""
    with opened(path) as file:
        rows, names = file["statistics"][()][whole_rows(file)], list(file["quantity"].asstr()[()])
        of = {name: rows[:, i] for i, name in enumerate(names)}
        slow = [np.sqrt(np.mean(of[name][:, STATISTICS.index("slow")] ** 2)) for name in ("surge", "sway", "yaw")]
        pull = max(one[:, STATISTICS.index("largest")].max() for name, one in of.items() if name.startswith("tension"))
        said, lines = told(file), file["line"].asstr()[()].tolist()
        every = tomllib.loads(file.attrs["study"])["simulation"].get("dynamic_lines") == "all"
        moving = lines if every else list(filter(None, file.attrs.get("moving_lines", "").split("\n")))
        levels = re.findall(r'qtf = "auto" uses ([a-z-]+)', "\n".join(said)) or ["full"]
        took = f"pairs {', '.join(levels)}; {len(moving)} of {len(lines)} lines move"
        return np.array([slow[0], slow[1], np.degrees(slow[2]), pull / 1e3]), said, took


def judged(default, everything, length):
    """(4,) whether a number is compared, and whether all that are come within TARGET"""
    size = np.abs(everything[:3]) * [1, 1, np.radians(length / 2)]
    counts = np.append(size > MINOR * size.max(), True)
    return counts, bool(np.all(np.abs(default / everything - 1)[counts] <= TARGET))


def compare(folder, name, scene, study, seeds, seconds):
    """Print one body; returns its verdict, a line"""
    study["simulation"] |= {"duration": seconds, "seeds": seeds, "keep_series": 1}
    base, whole = folder / f"{name}_body.h5", folder / f"{name}_pairs.h5"
    (folder / f"{name}_scene.toml").write_text(tomli_w.dumps(scene), encoding="utf-8")
    assert main(["solve", str(folder / f"{name}_scene.toml"), "--output", str(base)]) == 0
    if not whole.exists():
        shutil.copyfile(base, whole)
    towards = study["waves"].get("direction_deg", study["waves"].get("incidence_deg", 0) + 180) % 360
    omega = PAIRS[name.startswith("pontoon")]
    words = ["--heading", f"{towards:g}", "--omega", omega, "--difference", "0.3", "--level", "full"]
    assert main(["qtf", str(whole), *words]) in (0, 1)  # 1 where panels are coarse for the shortest of the waves
    asked = {**study, "simulation": study["simulation"] | {"dynamic_lines": "all", "qtf": "full"}}
    default, said, took = numbers(run(folder, f"{name}_default", study, base))
    everything, _, took_all = numbers(run(folder, f"{name}_everything", asked, whole))
    counts, within = judged(default, everything, scene["bodies"][0]["length"])
    print(f"\n{name}: {seeds} seeds of {seconds:g} s, by default ({took}) and with everything ({took_all})")
    words = "slow surge m", "slow sway m", "slow yaw °", "tension kN"
    for word, one, other, counted in zip(words, default, everything, counts, strict=True):
        ratio = f"ratio {one / other:.3f}" if counted else "nothing by symmetry"
        print(f"  {word:14}{one:12.4g}{other:12.4g}   {ratio}")
    first = said[0] if said else "nothing is told"
    print(f"  first line: {first}", flush=True)
    verdict = f"within {100 * TARGET:.0f} %" if within else "told" if first.startswith(LEFT_OUT) else "MISS"
    return f"{name}: {verdict}"


if __name__ == "__main__":
    folder, seeds, seconds = Path(sys.argv[1]), *(float(x) for x in (*sys.argv[2:4], "10", "1200")[:2])
    folder.mkdir(parents=True, exist_ok=True)
    bodies = {name: pontoon(*values) for name, values in PONTOONS.items()} | {"floater A": floater()}
    asked = sys.argv[4:] or bodies
    found = [compare(folder, name.replace(" ", "_"), *bodies[name], int(seeds), seconds) for name in asked]
    print("\n".join(["", *found]))
