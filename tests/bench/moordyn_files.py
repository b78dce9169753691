"""Every MoorDyn file below a folder: read, brought to rest, written, read again; with a peer run in MoorDyn too.

python tests/bench/moordyn_files.py FOLDER [--peer PYTHON] [--only TEXT]

A row a file: read or refused (why), what is left out, the largest tension at rest, the largest change of a force
after writing and reading again, and the difference of MoorDyn's tensions at both ends of every line at rest, over the
largest tension of the system.  MoorDyn gives the tension of its first and last segment; ours is taken at their middle.
With --peer the bodies are held where they are given, as a written file has them, free points are written where they
rest, and there is no friction, which a line that MoorDyn relaxes does not bring to bear; files are written with the
longest stable step and without bending stiffness.  MoorDyn's static solve comes first; where that leaves more than
0.5 %, its dynamic relaxation, of lines with drag and damping of our own choice, which statics do not feel ("relaxed").
Where that does too, the lines are cut as MoorDyn cuts them and their rest is found by Newton (`lumped_rest`, "cut"):
if MoorDyn is within 0.5 % of that, and with 16 to 256 times as many segments that is within 0.5 % of ours, the
difference is the error of MoorDyn's own mesh, and both numbers are told; if not, both runs again with twice as many
segments.
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
from lumped_rest import end_tensions

from hakobune.mooring.formats.moordyn import read_moordyn, write_moordyn
from hakobune.mooring.formats.moordyn_system import system_of_moordyn
from hakobune.mooring.formats.moordyn_writing import BED, moordyn_of_system
from hakobune.mooring.lines.system.equilibrium import held_at, rest
from hakobune.mooring.lines.system.parts import FreePoint, LineDynamics

HEADING = re.compile(r"^\s*-{3}.*(LINE TYPES|LINE DICTIONARY|LINES|RODS)\b", re.IGNORECASE | re.MULTILINE)
STATIC = {"dtIC": "2.0", "TmaxIC": "120", "threshIC": "1e-4", "ICgenDynamic": "0"}
DYNAMIC = {"dtIC": "5.0", "TmaxIC": "400", "threshIC": "1e-5", "CdScaleIC": "4", "ICgenDynamic": "1"}
CLOSE, PATIENCE = 5e-3, 120.0  # of the tension; s a run
FINER = (16, 64, 256)  # times MoorDyn's segments, of the cut lines that are to meet ours
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


def settled(point, places):
    """A free point where it rests: MoorDyn has not to swing it there for hundreds of seconds"""
    return replace(point, position=tuple(map(float, places[point.name]))) if point.name in places else point


def cut(system, finer, damped):
    """The system with its bodies held, its lines as `plain` and its free points where they rest; its state at rest"""
    held = held_at(system, {body.name: body.position for body in system.bodies})
    held = replace(held, lines=tuple(plain(line, finer, damped) for line in held.lines))
    state = at_rest(held)
    places = {point.name: state.points[i] for i, point in enumerate(held.points) if isinstance(point, FreePoint)}
    return replace(held, points=tuple(settled(point, places) for point in held.points)), state


def tensions_of_peer(python, file, held, folder, damped):
    """(n, 2) N of MoorDyn, in the first and the last segment.  raises : ValueError where it crashes"""
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
        raise ValueError((done.stderr.strip().splitlines() or ["crashed"])[-1][:60])
    return np.array(json.loads(done.stdout.strip().splitlines()[-1]))


def tensions_of_ours(state):
    """(n, 2) N in the middle of the first and the last segment"""
    lines, grounded = state.system.lines, state.lines.grounded_length
    heights = state.points[state.system.arrays.ends, 2]
    return np.array(
        [middles(line, *ends) for line, *ends in zip(lines, heights, *state.lines[:4], grounded, strict=True)]
    )


def apart(one, other, state):
    return float(np.abs(one - other).max() / max(state.tension))


def mesh_error(file, system, theirs, finer):
    """Difference of MoorDyn from cut lines with as many segments; how many times more bring these nearest to ours, and
    how near.

    theirs : [(n, 2) N] of which the nearest counts
    """
    bed = float(file.option("kBot", "kb", default=BED["kBot"]))
    state = cut(system, finer, False)[1]
    near = end_tensions(state, bed)
    for times in FINER:
        finest = cut(system, times * finer, False)[1]
        fine = apart(end_tensions(finest, bed), tensions_of_ours(finest), finest)
        if fine <= CLOSE:
            break
    return min(apart(one, near, state) for one in theirs), times, fine


def middles(line, heights, horizontal_a, horizontal_b, vertical_a, vertical_b, grounded):
    """N, in the middle of the first and the last segment, from the pulls on the ends; a is on the bed or hangs."""
    dry = line.type.weight if line.weight_in_air is None else line.weight_in_air
    half = [0.5 * (dry if z > 0 else line.type.weight) * line.length / line.elements for z in heights]
    lying = [end == 0 and grounded > 0 for end in (vertical_a, vertical_b)]
    ends = zip((horizontal_a, horizontal_b), (vertical_a, vertical_b), lying, half, strict=True)
    return [np.hypot(H, V - (0 if still else own)) for H, V, still, own in ends]


def with_peer(python, file, system, folder):
    """Differences found, [(times as many segments, how, difference or why there is none)], the last the best"""
    found = []
    for finer in (1, 2, 4):
        theirs = []
        for damped in (False, True):
            held, state = cut(system, finer, damped)
            try:
                theirs.append(tensions_of_peer(python, file, held, folder, damped))
                by = apart(theirs[-1], tensions_of_ours(state), state)
            except subprocess.TimeoutExpired:
                by = f"not done in {PATIENCE} s"
            except ValueError as error:
                by = str(error)
            found.append((finer, "relaxed" if damped else "static", by))
            if isinstance(by, float) and by <= CLOSE:
                return found
        if not theirs:  # with more segments still less
            break
        try:
            near, times, fine = mesh_error(file, system, theirs, finer)
        except ValueError as error:
            found.append((finer, "cut", str(error)))
            continue
        found += [(finer, "of MoorDyn from lines cut as it cuts them", near), (times * finer, "cut", fine)]
        if max(near, fine) <= CLOSE:
            return [*found, (finer, "less the error of its mesh", max(near, fine))]
    runs = [one for one in found if one[1] in ("static", "relaxed") and isinstance(one[2], float)]
    return [*found, min(runs, key=lambda one: one[2])] if runs else found


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
    """The tries: segments times, how, difference"""
    words = [f"{finer}× {how} {f'{by:.2e}' if isinstance(by, float) else by}" for finer, how, by in tries]
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
        "of these less the error of its mesh": sum(
            "tries" in one and one["tries"][-1][1] == "less the error of its mesh" for one in found
        ),
        "MoorDyn within 0.5 %": sum(isinstance(p := one.get("peer"), float) and p <= CLOSE for one in found),
    }
    print(", ".join(f"{name}: {value}" for name, value in count.items()))


if __name__ == "__main__":
    main()
