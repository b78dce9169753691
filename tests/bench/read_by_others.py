"""Exports read back by programs of others, in an environment of their own; the worst difference of each.

    python tests/bench/read_by_others.py --peer PYTHON

PYTHON has, as far as they install, pyHAMS, RAFT, mafredo (from Python 3.12 on), xarray with netCDF4, Capytaine, MoorPy,
and WEC-Sim's port to Python by PYTHONPATH.
Added mass, damping and forces over the largest of their kind, forces with their phases; of a mesh volume and area.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from hakobune.bem.database import open_database
from hakobune.mooring.formats.moordyn import write_moordyn
from hakobune.mooring.formats.moordyn_writing import moordyn_of_system
from hakobune.mooring.lines.system.equilibrium import held_at, rest
from hakobune.pipelines.cli import main
from hakobune.pipelines.lines.system_file import read_system

HERE = Path(__file__).parent
BOX = "--length 100 --beam 50 --draft 10 --depth 20 --gyration 15.6,29.4,32.3 --omega 0.3:1.2:10 --heading 0:180:7"
# format, file, reader, whether divided by density and gravity, whether its phases are those of exp(+iωt)
READS = (
    ("wamit", "box", "wamit_by_pyhams", True, True),
    ("wamit", "box", "wamit_by_raft", False, True),
    ("capytaine", "box.nc", "netcdf_out_by_capytaine", True, True),
    ("hams", "box_hams/Output/Wamit_format/Buoy", "wamit_by_pyhams", True, True),
    ("capytaine", "box.nc", "netcdf_by_xarray", False, False),
    ("capytaine", "box.nc", "netcdf_by_mafredo", False, False),
    ("orcaflex", "box.yml", "orcaflex_by_mafredo", False, False),
    ("bemio", "box_bemio.h5", "bemio_by_wecsim", True, True),
    ("wamit", "box.gdf", "mesh_by_capytaine", False, False),
)
SPREAD = """
[water]
depth = 60.0
[types]
chain = {{ catalogue = "R3 studless 76 mm" }}
wire = {{ catalogue = "wire 6x36 IWRC 1960 60 mm" }}
[[bodies]]
name = "barge"
{parts}"""


def differences(db, found, over, conjugate):
    """(A, B, F) largest difference over the largest of the kind: forces, moments and what couples them apart"""
    i = [int(np.argmin(np.abs(db.omega - w))) for w in found["omega"]]
    degrees = np.degrees(db.wave_direction)
    j = [int(np.argmin(np.abs((degrees - h + 180) % 360 - 180))) for h in found["headings"]]
    scale = (db.density, db.density * np.array(found["omega"])[:, None, None], db.density * db.gravity)
    A, B, F = (found[name] * (part if over else 1.0) for name, part in zip("ABF", scale, strict=True))
    F = F.conj() if conjugate else F
    ours = db["added_mass"][i], db["radiation_damping"][i], db["excitation_force"][i][:, j]
    return [apart(one, other) for one, other in zip(ours, (A, B, F), strict=True)]


def apart(ours, theirs):
    """Largest difference over the largest of its kind: of forces, of moments, and of what couples the two"""
    kind = np.arange(6) >= 3
    kinds = kind[:, None] * 2 + kind if ours.ndim == 3 and ours.shape[-2] == 6 else kind
    return max(
        np.abs((ours - theirs)[..., kinds == one]).max() / np.abs(ours[..., kinds == one]).max()
        for one in np.unique(kinds)
    )


def read(python, reader, place, folder):
    """Arrays that a reader of others finds, or None where it is not installed"""
    out = folder / f"{reader}.npz"
    words = [python, str(HERE / "readers_of_others.py"), reader, str(place), str(out)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode == 3:
        return None
    if done.returncode:
        print(f"{reader}: {done.stderr.strip().splitlines()[-1]}", file=sys.stderr)
        return None
    return dict(np.load(out))


def campaign(python):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        box = folder / "box.h5"
        if main(["box", *BOX.split(), "--output", str(box)]):
            return 1
        for form in {form for form, *_ in READS}:
            main(["export", str(box), "--to", form])
        db = open_database(box)
        print("format | reader | added mass | damping | force")
        for form, file, reader, over, conjugate in READS:
            found = read(python, reader, folder / file, folder)
            if found is None:
                print(f"{form} | {reader} | not installed")
            elif reader == "mesh_by_capytaine":
                mesh = db.mesh.whole()
                worst = found["A"].flat[0] / float(db.displaced_volume) - 1, found["B"].flat[0] / mesh.areas.sum() - 1
                print(f"{form} | {reader} | volume {worst[0]:.1e} | area {worst[1]:.1e}")
            else:
                worst = differences(db, found, over, conjugate)
                print(f"{form} | {reader} | " + " | ".join(f"{value:.1e}" for value in worst))
        print("moordyn | moordyn_by_moorpy | " + tensions(python, folder))
    return 0


def tensions(python, folder):
    """The largest difference of a tension that MoorPy finds of a MoorDyn file of ours, over the largest, in words"""
    parts = ""
    for i, (kind, length, *xy) in enumerate(
        (("chain", 306, -330, 0), ("wire", 300, 280, 190), ("chain", 312, 280, -190))
    ):
        x, y = np.array(xy) * 40 / np.hypot(*xy)
        ends = f'[[anchors]]\nname = "A{i}"\nposition = [{xy[0]}, {xy[1]}, -60]\n[[fairleads]]\nname = "F{i}"\n'
        ends += f'body = "barge"\nposition = [{x}, {y}, -2]\n[[lines]]\nname = "L{i}"\ntype = "{kind}"\n'
        parts += f'{ends}length = {length}\nfrom = "A{i}"\nto = "F{i}"\n'
    (folder / "spread.toml").write_text(SPREAD.format(parts=parts))
    system = read_system(folder / "spread.toml")
    system = held_at(system, {"barge": (0.0,) * 6})
    write_moordyn(moordyn_of_system(system), folder / "spread.dat")
    found = read(python, "moordyn_by_moorpy", folder / "spread.dat", folder)
    if found is None:
        return "not installed"
    ours = rest(system).lines
    ours = np.stack([ours.tension_a, ours.tension_b], axis=1)
    return f"tension {np.abs(found['A'][0, :3, :2] - ours).max() / ours.max():.1e}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peer", required=True)
    sys.exit(campaign(parser.parse_args().peer))
