"""Every file of other programs below a folder of fetched repositories: read, checked, told or refused.

python tests/bench/public_files.py FOLDER [--kinds sets,meshes,seas,lines] [--only TEXT] [--own]

A row a set (each body of a set by itself): repository, file, program, what was read, the laws it was held against, and
the verdict: "right" where all laws hold that can be tested, "told" where one does not, "refused" with the reason, and
"unchecked" where none can be tested.  With --own the hull that lies beside is solved too, as `hakobune import` does.
Depth, where a set does not say it, is that of the HydroDyn input that names it, or of DEPTHS by its path, else of
deep water.  Meshes, spectra and lines are judged as `public_meshes`, `public_seas` and `public_lines` say.  A file that
is another one byte by byte counts once; sums follow by kind, by program and by repository, and of data that are there
once: copies of one solution, hull, sea or system in other files or formats count as one.
"""

import argparse
import contextlib
import hashlib
import io
import re
import sys
import warnings
from collections import Counter
from importlib import import_module
from pathlib import Path

import numpy as np

from hakobune.bem.formats.judging import laws
from hakobune.bem.formats.judging.causes import finding
from hakobune.bem.formats.judging.own_solution import own_of, sample
from hakobune.bem.formats.values import FormatError, with_headings_once
from hakobune.meshing.files import read_mesh

sys.path.insert(0, str(Path(__file__).parent))

import public_lines
import public_meshes
import public_seas

DEPTHS = {"HydroData/barge.1": 150.0, "HydroData/spar.1": 320.0, "tlpmit.1": 200.0, "marin_semi": 200.0,
          "UMaineSemi": 200.0, "OC3": 320.0, "OC4": 200.0, "VolturnUS": 200.0, "MHK_RM1": 60.0,
          "IEA-22": 300.0}  # fmt: skip
FIRST = 4096  # bytes that tell what a file is
MOST_BODIES = 12


def begins(path, *marks):
    with open(path, "rb") as file:
        head = file.read(FIRST)
    return any(mark in head for mark in marks)


def holds(path, mark):
    return mark in path.read_bytes()


def is_wamit(path):
    """A .1 with rows of four or five numbers, that is not of HAMS, which knows the depth"""
    if path.parent.name == "Wamit_format":
        return False
    for line in path.read_text("utf-8", errors="replace").splitlines()[:8]:
        words = line.split()
        if len(words) in (4, 5) and words[1].isdigit() and words[2].isdigit():
            return True
    return False


def with_results(path):
    """Whether a folder of Nemoh has been run"""
    return path.name.lower() == "nemoh.cal" and any(path.parent.glob("[rR]esults/RadiationCoefficients.tec"))


def of_hams(path):
    return path.name.lower() == "controlfile.in" and any(path.parent.parent.glob("Output/Wamit_format/*.1"))


def netcdf(path):
    return begins(path, b"CDF", b"HDF") and holds(path, b"added_mass")


# suffix: (format of hakobune, whether the file is one, the place that is read)
SETS = {
    ".1": ("wamit", is_wamit, None),
    ".out": ("wamit", lambda path: begins(path, b"WAMIT"), None),
    ".in": ("hams", of_hams, lambda path: path.parent.parent),
    ".cal": ("nemoh", with_results, lambda path: path.parent),
    ".nc": ("capytaine", netcdf, None),
    ".h5": ("bemio", lambda path: holds(path, b"simulation_parameters"), None),
    ".yml": ("orcaflex", lambda path: holds(path, b"VesselTypes:"), None),
    ".rao": ("hydrostar", lambda path: path.stem == "AddedMass_11", lambda path: path.parent),
    ".dat": ("hydrostar", lambda path: path.stem == "AddedMass_11", lambda path: path.parent),
    ".hdb": ("diodore", lambda path: True, None),
    ".ah1": ("aqwa", lambda path: True, None),
    ".lis": ("aqwa", lambda path: holds(path, b"AQWA"), None),
}


def sets(folder):
    """(file, format, place) of hydrodynamic sets; a .out beside a .1 of the same name is one more"""
    for path in sorted(Path(folder).rglob("*")):
        kind = SETS.get(path.suffix.lower())
        if kind and path.is_file() and kind[1](path):
            yield path, kind[0], (kind[2] or (lambda same: same))(path)


def depth_of_hydrodyn(path):
    """m, of an input of HydroDyn up to three folders above that names the set; None without one, or where it is of
    another file
    """
    for file in (file for folder in list(path.parents)[:3] for file in sorted(folder.glob("*.dat"))):
        text = file.read_text("utf-8", "replace")
        named = re.search(r"^\s*\"?([^\"\n]+?)\"?\s+PotFile", text, re.MULTILINE)
        depth = re.search(r"^\s*([\d.]+)\s+WtrDpth", text, re.MULTILINE)
        if named and depth and re.split(r"[\\/]", named[1])[-1] == path.stem:
            return float(depth[1])
    return None


def known_of(path, place, body):
    depth = next((value for part, value in DEPTHS.items() if part in str(path)), None)
    depth = depth_of_hydrodyn(path) or depth
    return {"water_depth": depth, "density": 1025.0, "gravity": 9.80665, "body": body}


def read(path, module, place, body):
    """(Values, remark); depth is asked for where a file says none"""
    known, remark = known_of(path, place, body), ""
    try:
        values = module.read(place, known)
    except FormatError as error:
        if "--depth is missing" not in str(error):
            raise
        values, remark = module.read(place, known | {"water_depth": np.inf}), "deep water taken; "
        depth = laws.depth_of(values)
        if depth is not None:  # what `hakobune import` asks for
            values, remark = module.read(place, known | {"water_depth": depth}), f"--depth {depth:.3g} as told; "
    return with_headings_once(values), remark


def rows_of_set(path, kind, place, solve):
    """(read, checked, verdict) of each body of a set"""
    module = import_module(f"hakobune.bem.formats.{kind}")
    body = None
    while True:
        try:
            yield checked(*read(path, module, place, body), module, place, solve, body)
        except FormatError as error:
            if "allowed: --body 1 to" in str(error) and body is None:
                body = 1
                continue
            if "--body is" in str(error):
                return
            yield "", "", f"refused: {str(error).replace(str(place), place.name)}"
        except Exception as error:  # a traceback is a fault of ours, and told as that
            yield "", "", f"TRACEBACK {type(error).__name__}: {error}"
        if body is None or body >= MOST_BODIES:
            return
        body += 1


def mark_of(values):
    """Text that is equal for copies of one solution"""
    A, B = (np.abs(np.einsum("nii->ni", values.get(name))) for name in ("added_mass", "radiation_damping"))
    return " ".join(f"{number:.3g}" for number in (*A.max(axis=0), *B.max(axis=0)))


def checked(values, remark, module, place, solve, body):
    found, tested = laws.doubts(values)
    words = f"{len(values.omega)} ω, {len(values.wave_direction)} β" + (f", body {body}" if body else "")
    if solve:
        said = against_hull(values, module, place, body)
        if said:
            tested, found = [*tested, "own solution"], found if said == "agrees" else [said, *found]
    weighty = [name for name in tested if name not in ("reciprocity", "energy")]
    verdict = "told: " + "; ".join(found) if found else "right" if weighty else "unchecked"
    return words, ", ".join(tested), remark + verdict, mark_of(values)


def against_hull(values, module, place, body):
    """ "agrees", what differs, or "" without a hull or too large a one"""
    hull = module.hull_of(place, {"body": body}) if hasattr(module, "hull_of") else None
    if module.__name__.endswith("hams"):
        hull = place / "Input" / "HullMesh.pnl"
    if hull is None or not Path(hull).is_file() or values.others:
        return ""
    try:
        mesh = read_mesh(Path(hull))
    except ValueError as error:
        return f"hull not read: {error}"
    if module.__name__.endswith("wamit"):
        mesh = mesh.moved(*values.rotation_center)
    own = own_of(values, mesh.clipped())
    if own is None:
        return ""
    said = finding(sample(values, mesh), own)
    if said is None:
        return "agrees"
    return f"{said.quantity} {100 * said.gap:.3g} % off, {said.cause.text if said.cause else 'no single cause'}"


def of_sets(folder, asked):
    for path, kind, place in sets(folder):
        if asked.only in str(path):
            for words, laws_, verdict, *mark in rows_of_set(path, kind, place, asked.own):
                yield path, kind, words, laws_, verdict, *mark


def of_family(found, judged, checks):
    """Rows of the files that one of the benches beside this finds, each by itself"""

    def rows(folder, asked):
        for path in found(folder):
            if asked.only in str(path):
                yield path, program_of(path), *row_of(path, judged, checks)

    return rows


def row_of(path, judged, checks):
    try:
        verdict, why = judged(path)
    except Exception as error:
        return "", "", f"TRACEBACK {type(error).__name__}: {error}"
    why = " ".join(why.split())
    return ("", "", f"{verdict}: {why}") if verdict != "right" else (why, checks, verdict)


def program_of(path):
    """What wrote a file, as far as its ending or first line tells"""
    ending = path.suffix.lower().lstrip(".")
    if ending in ("yaml", "yml"):
        return "yaml"
    head = public_seas._head(path).upper()
    known = next((word for word in ("SWAN", "WAVEWATCH", "TRIAXYS", "MOORDYN", "MAP") if word in head), "")
    return known.lower() or ("ndbc" if head.startswith(("#YY", "YY")) else ending)


# kind of file: rows of (path, program, read, checked, verdict) below a folder
KINDS = {
    "sets": of_sets,
    "meshes": of_family(public_meshes.of_meshes, public_meshes.judged, "findings, three volumes, lid"),
    "seas": of_family(public_seas.of_seas, public_seas.judged, "height"),
    "lines": of_family(public_lines.of_lines, public_lines.judged, "rest"),
}


def first_time(path, kind, seen):
    """Whether this is the first file of its kind with these bytes, or a further body of it"""
    mark = kind, hashlib.sha1(path.read_bytes()).digest()
    return seen.setdefault(mark, path) == path


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--only", default="")
    parser.add_argument("--own", action="store_true")
    asked, seen, sums, data = parser.parse_args(), {}, {}, set()
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    for kind in asked.kinds.split(","):
        with contextlib.redirect_stderr(io.StringIO()):
            for path, program, words, tested, verdict, *mark in KINDS[kind](asked.folder, asked):
                if not first_time(path, kind, seen):
                    continue
                name = path.relative_to(asked.folder)
                print(f"{str(name)[:100]} | {program} | {words} | {tested} | {verdict[:300]}", flush=True)
                word = verdict.split("taken; ")[-1].split("as told; ")[-1].split(":")[0].split()[0]
                mark = (kind, *(mark or (words, verdict.replace(path.name, ""))))
                once = () if mark in data else (f"{kind} once", "all once")
                data.add(mark)
                for group in (name.parts[0], f"{kind} {program}", f"all {kind}", "all", *once):
                    sums.setdefault(group, Counter())[word] += 1
    for group, found in sums.items():
        share = 100 * found["right"] / sum(found.values())
        print(f"{group:40s} {share:3.0f} % right:", ", ".join(f"{word} {n}" for word, n in found.most_common()))


if __name__ == "__main__":
    main()
