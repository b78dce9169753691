"""What `hakobune simulate` takes where a study says nothing, beside everything: memory, all lines moving, all pairs.

    python tests/bench/defaults_beside_everything.py FOLDER [SEEDS] [SECONDS] [NAME …]

Three pontoons in shallow water and floater A of `hakobune new simulation`, by default ten seeds of 1 200 s.  With
"everything" are meant dynamic_lines = "all" and the pairs that `hakobune qtf` stores, in a second database; where they
do not reach the waves, what "auto" has.  Printed are σ of slow surge, sway and yaw over the seeds, the largest
tension of all, both beside each other, and the first lines of the answer by default.  Databases and runs stay in the
folder and are not made again.
"""

import shutil
import sys
import tomllib
from pathlib import Path

import numpy as np
import tomli_w

from hakobune.pipelines.cli import main
from hakobune.pipelines.simulate.file import STATISTICS, opened, told, whole_rows

SCENES = Path(__file__).parents[2] / "pipelines" / "scenes"
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
    """σ of slow surge, sway (m) and yaw (°) over the seeds, the largest tension kN, and what the file tells"""
    with opened(path) as file:
        rows, names = file["statistics"][()][whole_rows(file)], list(file["quantity"].asstr()[()])
        of = {name: rows[:, i] for i, name in enumerate(names)}
        slow = [np.sqrt(np.mean(of[name][:, STATISTICS.index("slow")] ** 2)) for name in ("surge", "sway", "yaw")]
        pull = max(one[:, STATISTICS.index("largest")].max() for name, one in of.items() if name.startswith("tension"))
        return np.array([slow[0], slow[1], np.degrees(slow[2]), pull / 1e3]), told(file)


def compare(folder, name, scene, study, seeds, seconds):
    """Print one body"""
    study["simulation"] |= {"duration": seconds, "seeds": seeds, "keep_series": 1}
    base, whole = folder / f"{name}_body.h5", folder / f"{name}_pairs.h5"
    (folder / f"{name}_scene.toml").write_text(tomli_w.dumps(scene), encoding="utf-8")
    assert main(["solve", str(folder / f"{name}_scene.toml"), "--output", str(base)]) == 0
    if not whole.exists():
        shutil.copyfile(base, whole)
    towards = study["waves"].get("direction_deg", study["waves"].get("incidence_deg", 0) + 180) % 360
    main(["qtf", str(whole), "--heading", f"{towards:g}", "--omega", "0.4:2.0:33", "--difference", "0.3"])
    asked = {**study, "simulation": study["simulation"] | {"dynamic_lines": "all"}}
    default, said = numbers(run(folder, f"{name}_default", study, base))
    everything, _ = numbers(run(folder, f"{name}_everything", asked, whole))
    print(f"\n{name}: {seeds} seeds of {seconds:g} s, by default and with everything")
    words = "slow surge m", "slow sway m", "slow yaw °", "tension kN"
    for word, one, other in zip(words, default, everything, strict=True):
        print(f"  {word:14}{one:12.4g}{other:12.4g}   ratio {one / other:.3f}")
    print("\n".join(f"  {line}" for line in said), flush=True)


if __name__ == "__main__":
    folder, seeds, seconds = Path(sys.argv[1]), *(float(x) for x in (*sys.argv[2:4], "10", "1200")[:2])
    folder.mkdir(parents=True, exist_ok=True)
    bodies = {name: pontoon(*values) for name, values in PONTOONS.items()} | {"floater A": floater()}
    for name, (scene, study) in bodies.items():
        if not sys.argv[4:] or name in sys.argv[4:]:
            compare(folder, name.replace(" ", "_"), scene, study, int(seeds), seconds)
