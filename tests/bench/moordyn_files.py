"""Every MoorDyn file below a folder: read, brought to rest, written, read again; with a peer run in MoorDyn too.

python tests/bench/moordyn_files.py FOLDER [--peer PYTHON] [--only TEXT]

A row a file: read or refused (why), what is left out, the largest tension at rest, the largest change of a force
after writing and reading again, and the difference of MoorDyn's tensions at both ends of every line at rest, over the
largest tension of the system.  MoorDyn gives the tension of its first and last segment; ours is taken at their middle.
With --peer the bodies are held where they are given, as a written file has them, and there is no friction, which a
line that MoorDyn relaxes does not bring to bear; files are written with the longest stable step and without bending
stiffness.  MoorDyn's static solve comes first; where that leaves more than 0.5 %, its dynamic relaxation, of lines with
drag and damping of our own choice, which statics do not feel ("relaxed"); where that does too, both again with twice
as many segments a line, and so on for as long as the difference falls: the error of MoorDyn's own mesh goes with them.
PYTHON is one that has moordyn (2.7.2).
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np

from mooring.formats.moordyn import read_moordyn, write_moordyn
from mooring.formats.moordyn_system import system_of_moordyn
from mooring.formats.moordyn_writing import moordyn_of_system
from mooring.lines.system.equilibrium import held_at, rest
from mooring.lines.system.parts import LineDynamics

HEADING = re.compile(r"^\s*-{3}.*(LINE TYPES|LINE DICTIONARY|LINES|RODS)\b", re.IGNORECASE | re.MULTILINE)
STATIC = {"dtIC": "2.0", "TmaxIC": "120", "threshIC": "1e-4", "ICgenDynamic": "0"}
DYNAMIC = {"dtIC": "5.0", "TmaxIC": "400", "threshIC": "1e-5", "CdScaleIC": "4", "ICgenDynamic": "1"}
CLOSE, PATIENCE = 5e-3, 120.0  # of the tension; s a run
PEER = """
import json, sys, moordyn
system = moordyn.Create(sys.argv[1])
moordyn.Init(system, json.loads(sys.argv[2]), [0.0] * len(json.loads(sys.argv[2])))
lines = [moordyn.GetLine(system, i + 1) for i in range(moordyn.GetNumberLines(system))]
ends = [[moordyn.GetLineNodeTen(l, i) for i in (0, moordyn.GetLineN(l))] for l in lines]
ends = [[sum(x * x for x in end) ** 0.5 for end in pair] for pair in ends]
print("\\n" + json.dumps(ends))
"""


def files(folder):
    """MoorDyn inputs by their headings, MAP's left aside."""
    for path in sorted(Path(folder).rglob("*")):
        if path.suffix.lower() in (".txt", ".dat", ".inp") and path.is_file():
            text = path.read_text("utf-8", errors="replace")
            if HEADING.search(text) and "MAP" not in path.stem and not path.stem.endswith("_out"):
                yield path


def read(path):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        file = read_moordyn(path)
        system = system_of_moordyn(file, path)
    return file, system, [str(one.message).removeprefix(f"{path}: ") for one in said]


def at_rest(system):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return rest(system)


def written_again(file, system, folder):
    """The largest change of a force at the given pose after writing and reading, over the largest."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = Path(folder) / "again.txt"
        write_moordyn(moordyn_of_system(system, file), path)
        again = system_of_moordyn(read_moordyn(path), path)
    before, after = system.load().rows[:, 1:5], again.load().rows[:, 1:5]
    for a, b in zip(system.lines, again.lines, strict=True):
        assert replace(a.type, name="", source="") == replace(b.type, name="", source="")
        assert (a.length, b.elements) == (b.length, a.elements or b.elements)
    return float(np.abs(after - before).max() / np.abs(before).max())


def plain(line, finer, damped):
    dynamics = LineDynamics() if damped else replace(line.type.dynamics, bending_stiffness=0.0)
    kind = replace(line.type, dynamics=dynamics)
    return replace(line, type=kind, elements=finer * (line.elements or 20), bed_friction=0.0)


def against_peer(python, file, system, folder, finer, damped):
    """The largest difference of MoorDyn's tension at an end of a line, over the largest tension."""
    held = held_at(system, {body.name: body.position for body in system.bodies})
    held = replace(held, lines=tuple(plain(line, finer, damped) for line in held.lines))
    kept = {name: value for name, value in file.options.items() if name.lower() not in ("dt", "dtm")}
    source = replace(file, options={**kept, **(DYNAMIC if damped else STATIC)})
    path = Path(folder) / "peer.txt"
    write_moordyn(moordyn_of_system(held, source), path)
    places = [float(x) for body in held.bodies for x in body.position]
    done = subprocess.run(
        [python, "-c", PEER, str(path), json.dumps(places)],
        capture_output=True,
        text=True,
        cwd=folder,
        timeout=PATIENCE,
    )
    if done.returncode:
        return (done.stderr.strip().splitlines() or ["crashed"])[-1][:60]
    theirs = np.array(json.loads(done.stdout.strip().splitlines()[-1]))
    state = at_rest(held)
    ours = np.array(
        [
            middles(line, *ends)
            for line, *ends in zip(held.lines, *state.lines[:4], state.lines.grounded_length, strict=True)
        ]
    )
    return float(np.abs(theirs - ours).max() / max(state.tension))


def middles(line, horizontal_a, horizontal_b, vertical_a, vertical_b, grounded):
    """N, in the middle of the first and the last segment, from the pulls on the ends; a is on the bed or hangs."""
    half = 0.5 * line.type.weight * line.length / line.elements
    lying = [end == 0 and grounded > 0 for end in (vertical_a, vertical_b)]
    ends = zip((horizontal_a, horizontal_b), (vertical_a, vertical_b), lying, strict=True)
    return [np.hypot(H, V - (0 if still else half)) for H, V, still in ends]


def with_peer(python, file, system, folder):
    """Differences found, [(times as many segments, relaxed, difference or why there is none)], the last the best"""
    found, before = [], np.inf
    for finer in 2 ** np.arange(9):
        for damped in (False, True):
            try:
                found.append((finer, damped, against_peer(python, file, system, folder, finer, damped)))
            except subprocess.TimeoutExpired:
                found.append((finer, damped, f"not done in {PATIENCE} s"))
            if isinstance(found[-1][2], float) and found[-1][2] <= CLOSE:
                return found
        now = min([one[2] for one in found[-2:] if isinstance(one[2], float)], default=np.inf)
        if not now < 0.8 * before:
            break
        before = now
    return sorted(found, key=lambda one: -one[2] if isinstance(one[2], float) else -np.inf)


def row(path, peer, folder):
    try:
        file, system, said = read(path)
    except (ValueError, OSError) as error:
        return dict(read=False, why=str(error).removeprefix(str(path)), said=[])
    found = dict(read=True, said=said)
    try:
        found["tension"] = at_rest(system).tension.max()
    except ValueError as error:
        found["why"] = str(error)
        return found
    try:
        found["again"] = written_again(file, system, folder)
        if peer:
            found["tries"] = with_peer(peer, file, system, folder)
            found["peer"] = found["tries"][-1][2]
    except ValueError as error:
        found["why"] = str(error)[:150]
    return found


def told(tries):
    """The tries, from the worst to the last: segments times, statics or relaxed, difference"""
    words = [
        f"{finer}× {'relaxed' if damped else 'static'} {f'{by:.2e}' if isinstance(by, float) else by}"
        for finer, damped, by in tries
    ]
    return " of " + ", ".join(words)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--peer")
    arguments.add_argument("--only", default="", help="files with this in their path")
    given = arguments.parse_args()
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for path in files(given.folder):
            if given.only not in str(path):
                continue
            one = row(path, given.peer, folder)
            found.append(one)
            state = "read" if one["read"] else "REFUSED"
            numbers = f"{one['tension'] / 1e3:10.4g} kN  again {one['again']:.1e}" if "again" in one else ""
            print(f"{path.relative_to(given.folder)}: {state} {numbers} {one.get('why', '')}", end=" ")
            print(f"peer {one['peer']:.2e}" if isinstance(one.get("peer"), float) else one.get("peer", ""), end="")
            print(told(one["tries"]) if len(one.get("tries", ())) > 1 else "")
            for text in one["said"]:
                print(f"    left out or assumed: {text}")
            sys.stdout.flush()
    count = {
        "files": len(found),
        "read": sum(one["read"] for one in found),
        "at rest": sum("tension" in one for one in found),
        "written and read again within 1e-9": sum(one.get("again", 1) <= 1e-9 for one in found),
        "MoorDyn within 0.5 %": sum(isinstance(p := one.get("peer"), float) and p <= CLOSE for one in found),
    }
    print(", ".join(f"{name}: {value}" for name, value in count.items()))


if __name__ == "__main__":
    main()
