"""Good inputs of every command, and ways to spoil them: each gives (what was done, command line) of a case."""

from __future__ import annotations

import contextlib
import copy
import math
import os
import random
import shutil
import tomllib
from pathlib import Path

import tomli_w

from hakobune import pipelines

SCENES = Path(pipelines.__file__).parent / "scenes"
BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --gyration 15.6,29.4,32.3 --heading 0,45,90"
SYSTEM = """[water]
depth = 20.0

[types.chain]
catalogue = "R3 studless 76 mm"

[[bodies]]
name = "box"
freedom = ["Surge"]
force_kN = [100.0, 0.0, 0.0]
""" + "".join(
    f"""
[[anchors]]
name = "anchor {side}"
position = [{x}, 0.0, -20.0]

[[fairleads]]
name = "fairlead {side}"
body = "box"
position = [{x / 10}, 0.0, 0.0]

[[lines]]
name = "{side}"
type = "chain"
length = 140.0
from = "anchor {side}"
to = "fairlead {side}"
"""
    for side, x in (("ahead", 150.0), ("astern", -150.0))
)
MAKING = (
    "solve scene.toml --output box.h5",
    "sea --height 3 --mean-period 8 --record waves.csv",
    "sea --height 3 --mean-period 8 --output spectrum.csv",
    "lines system.toml --moordyn system.dat",
    "simulate time.toml --database box.h5 --output time.h5",
)
# {command line: the files it reads}; the names are those in the folder that `good_inputs` makes
COMMANDS = {
    f"{BOX} --omega 0.5 --output new.h5": (),
    "buoy --radius 10 --draft 10 --depth 30 --omega 0.5 --heading 0 --output new.h5": (),
    "solve scene.toml --output new.h5": ("scene.toml",),
    "solve scene.toml --output box.h5": ("scene.toml", "box.h5"),
    "solve --mesh mesh.gdf --depth 20 --omega 0.5 --heading 0 --output new.h5": ("mesh.gdf",),
    "solve --mesh mesh.pnl --depth 20 --omega 0.5 --heading 0 --mesh-only --output new.msh": ("mesh.pnl",),
    "look mesh.nemoh --plot new.png": ("mesh.nemoh",),
    "look mesh.vtu --plot new.png": ("mesh.vtu",),
    "look mesh.ply --plot new.png": ("mesh.ply",),
    "look box.h5 --plot new.png": ("box.h5",),
    "plot box.h5 --output new.png": ("box.h5",),
    "check box.h5": ("box.h5",),
    "moor moor.toml --database box.h5 --output new.h5": ("moor.toml", "box.h5"),
    "response response.toml --database box.h5 --output new.csv": ("response.toml", "box.h5"),
    "response climate.toml --database box.h5 --output new.h5": ("climate.toml", "response_climate.csv"),
    "line --weight 1000 --stiffness 1e6 --length 100 --depth 20 --span 90": (),
    "lines system.toml --output new.h5 --offset 1": ("system.toml",),
    "lines system.dat --depth 20": ("system.dat",),
    "line-dynamics line.toml --duration 20 --output new.h5": ("line.toml",),
    "sea --height 3 --mean-period 8 --record new.csv --duration 600": (),
    "sea waves.csv --output new.csv": ("waves.csv",),
    "sea --table spectrum.csv": ("spectrum.csv",),
    "sections --beam-draft 5 --depth-draft 2 --xi 1 --output new.csv": (),
    "simulate time.toml --database box.h5 --output new.h5": ("time.toml", "box.h5"),
    "simulate time.toml --database box.h5 --output time.h5 --seeds 3": ("time.toml", "time.h5"),
    "animate time.h5 --output new.gif --length 2 --seed 1": ("time.h5",),
    "check time.h5": ("time.h5",),
    "ship --length 90 --beam 20 --draft 6 --block .8 --depth 9 --panels 60 --omega 0.5 --heading 0 --output new.h5": (),
    "fender --family cell --height 2 --energy 900 --plot new.png": (),
    "fender --table fender.csv --height 1.2 --energy 50": ("fender.csv",),
    "berth berth.toml --output new.csv": ("berth.toml",),
    "damping decay.csv --mass 1000 --plot new.png": ("decay.csv",),
    "breakwater breakwater.toml --output new.h5": ("breakwater.toml", "breakwater_rectangle.csv"),
    "single-point single_point.toml --output new.h5": ("single_point.toml",),
    "earthquake earthquake.toml --output new.csv --plot new.png": ("earthquake.toml", "ground.csv"),
    "simulate quay.toml --database box.h5 --output new.h5 --windows 20": ("quay.toml", "berth.csv"),
    "keys study lines": (),
    "new study new.toml": (),
}
TIME = """
[simulation]
duration = 60.0
ramp = 20.0
seeds = 1
keep_series = 2
tolerance = 1e-2
memory = "constant"
dynamic_lines = "none"
qtf = "newman"
damping_ratio = { roll = 0.05 }
lines_lost = [{ line = "fore port 1", time = 30.0 }]
"""
QUAY = {
    "duration": 60.0,
    "ramp": 20.0,
    "memory": "constant",
    "damping_ratio": {"roll": 0.02},
    "record": {"file": "berth.csv", "direction_deg": 90.0},
}
FENDER = """strain,reaction_kN
0,0
0.1,40
0.2,90
0.3,120
0.4,130
0.5,135
0.55,180
"""
NUMBERS = (
    "nan",
    "inf",
    "-inf",
    "0",
    "-1",
    "1e-300",
    "1e300",
    "1e12",
    "",
    "text",
    "1,2,3,4,5,6,7",
    "0:1:1000000000",
    "²",
)
VALUES = (math.nan, math.inf, -math.inf, 0, -1.0, 1e-300, 1e300, 1e12, "text", "", [], {}, True, [1.0] * 9, [[[]]])


def good_inputs(folder):
    """Every file that COMMANDS read, in a folder; the database is solved, which takes some seconds."""
    from hakobune.meshing.files import write_mesh
    from hakobune.meshing.shapes import box
    from hakobune.pipelines.cli import main

    folder = Path(folder)
    here = Path.cwd()
    os.chdir(folder)
    try:
        for source, name in (
            ("series_box_20m", "scene"),
            ("moor_chain_12", "moor"),
            ("response_box_20m", "response"),
            ("response_climate", "climate"),
            ("line_chain_60m", "line"),
            ("berth_tanker", "berth"),
            ("breakwater_rectangle", "breakwater"),
            ("single_point_A", "single_point"),
            ("earthquake_box", "earthquake"),
            ("simulate_quay", "quay"),
        ):
            shutil.copy(SCENES / f"{source}.toml", f"{name}.toml")
        for name in ("response_climate.csv", "breakwater_rectangle.csv"):
            shutil.copy(SCENES / name, name)
        Path("fender.csv").write_text(FENDER, encoding="utf-8")
        times = [0.1 * i for i in range(400)]
        decay = (f"{t},{math.exp(-0.02 * t) * math.cos(0.8 * t)}\n" for t in times)
        Path("decay.csv").write_text("time_s,motion_m\n" + "".join(decay), encoding="utf-8")
        shaken = (f"{t},{math.exp(-0.1 * t) * math.sin(5 * t)}\n" for t in times)
        Path("ground.csv").write_text("time_s,acceleration_m_s2\n" + "".join(shaken), encoding="utf-8")
        with open("earthquake.toml", "a", encoding="utf-8") as file:
            file.write('\n[record]\nfile = "ground.csv"\n')
        heights = (f"{t},{0.3 * math.cos(0.6 * t)}\n" for t in range(100))
        Path("berth.csv").write_text("time_s,elevation_m\n" + "".join(heights), encoding="utf-8")
        quay = tomllib.loads(Path("quay.toml").read_text(encoding="utf-8"))
        quay.pop("waves")
        quay["simulation"] = QUAY
        quay["harbour"] = {"periods": [60.0]}
        Path("quay.toml").write_text(tomli_w.dumps(quay), encoding="utf-8")
        scene = tomllib.loads(Path("scene.toml").read_text(encoding="utf-8"))
        scene["waves"] = {"omegas": [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0], "headings_deg": [0, 45, 90]}
        Path("scene.toml").write_text(tomli_w.dumps(scene), encoding="utf-8")
        Path("system.toml").write_text(SYSTEM, encoding="utf-8")
        Path("time.toml").write_text(Path("moor.toml").read_text(encoding="utf-8") + TIME, encoding="utf-8")
        mesh = box(100, 50, 10, panels=60)
        for ending in ("gdf", "pnl", "nemoh", "vtu"):
            write_mesh(mesh, f"mesh.{ending}")
        _write_ply(mesh.whole(), "mesh.ply")
        for line in MAKING:
            with open("said.txt", "w", encoding="utf-8") as said, contextlib.redirect_stdout(said):
                assert main(line.split()) == 0, line
        Path("said.txt").unlink()
    finally:
        os.chdir(here)


def _write_ply(mesh, path):
    rows = [" ".join(map(str, point)) for point in mesh.points]
    faces = [f"4 {' '.join(map(str, panel))}" for panel in mesh.corners]
    head = ["ply", "format ascii 1.0", f"element vertex {len(rows)}", *(f"property double {c}" for c in "xyz"),
            f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]  # fmt: skip
    Path(path).write_text("\n".join([*head, *rows, *faces, ""]), encoding="utf-8")


def spoiled(seed, count):
    """`count` cases (what, words, spoil): spoil(folder) changes the good inputs of the folder it is given."""
    chance = random.Random(seed)
    for _ in range(count):
        line = chance.choice(list(COMMANDS))
        files = COMMANDS[line]
        kinds = [_flag, _flag, _output] + [_file] * 3 * bool(files)
        yield chance.choice(kinds)(chance, line, files)


def _nothing(folder):
    pass


def _flag(chance, line, files):
    """A value of a flag replaced, a flag left out, or one that does not exist"""
    words = line.split()
    flags = [i for i, word in enumerate(words) if word.startswith("--") and word not in ("--output", "--mesh-only")]
    if not flags or chance.random() < 0.05:
        return f"{line} --nonsense 1", [*words, "--nonsense", "1"], _nothing
    i = chance.choice(flags)
    if chance.random() < 0.1:
        del words[i : i + 2]
    elif i + 1 < len(words):
        words[i + 1] = chance.choice(NUMBERS)
    return " ".join(words), words, _nothing


def _output(chance, line, files):
    """A result where none may be written"""
    words = line.split()
    places = [i + 1 for i, word in enumerate(words) if word in ("--output", "--plot", "--record")]
    if not places:
        return _flag(chance, line, files)
    ending = Path(words[places[0]]).suffix
    what = chance.choice(["none/new" + ending, "new.xyz", "new", ".", "/dev/full", "scene.toml", "readonly" + ending,
                          "a" * 300 + ending, "box.h5", "response_climate.csv"])  # fmt: skip
    words[places[0]] = what

    def spoil(folder):
        (folder / ("readonly" + ending)).mkdir()

    return " ".join(words), words, spoil


def _file(chance, line, files):
    """A file that is read, damaged"""
    name = chance.choice(files)
    ways = [truncated, random_bytes, emptied, removed, folder_instead, pipe_instead, endless]
    if name.endswith(".toml"):
        ways += [leaf_replaced] * 12 + [key_added, key_removed, key_removed, nested, with_byte_order_mark]
    elif not name.endswith(".h5"):
        ways += [word_replaced] * 6 + [line_removed, line_doubled, with_byte_order_mark, nested]
    way, seed = chance.choice(ways), chance.random()

    def spoil(folder):
        way(folder / name, random.Random(seed))

    return f"{way.__name__} {name} ({seed:.6f}): {line}", line.split(), spoil


def truncated(path, chance):
    data = path.read_bytes()
    path.write_bytes(data[: chance.randrange(len(data))])


def random_bytes(path, chance):
    data = bytearray(path.read_bytes())
    for _ in range(chance.choice([1, 8, 64])):
        data[chance.randrange(len(data))] = chance.randrange(256)
    path.write_bytes(bytes(data))


def emptied(path, chance):
    path.write_bytes(b"")


def removed(path, chance):
    path.unlink()


def folder_instead(path, chance):
    path.unlink()
    path.mkdir()


def pipe_instead(path, chance):
    path.unlink()
    os.mkfifo(path)


def endless(path, chance):
    path.unlink()
    path.symlink_to("/dev/zero")


def with_byte_order_mark(path, chance):
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))


def nested(path, chance):
    path.write_text("a = " + "[" * 10_000, encoding="utf-8")


def line_removed(path, chance):
    lines = path.read_text(encoding="utf-8").splitlines()
    del lines[chance.randrange(len(lines))]
    path.write_text("\n".join(lines), encoding="utf-8")


def line_doubled(path, chance):
    lines = path.read_text(encoding="utf-8").splitlines()
    i = chance.randrange(len(lines))
    path.write_text("\n".join([*lines[:i], lines[i], *lines[i:]]), encoding="utf-8")


def word_replaced(path, chance):
    lines = path.read_text(encoding="utf-8").splitlines()
    i = chance.randrange(len(lines))
    words = lines[i].replace(",", " , ").split()
    if words:
        words[chance.randrange(len(words))] = chance.choice(NUMBERS)
    lines[i] = " ".join(words)
    path.write_text("\n".join(lines), encoding="utf-8")


def _leaves(value, path=()):
    parts = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in parts:
        yield (*path, key)
        yield from _leaves(part, (*path, key))


def _edited(path, chance, change):
    raw = copy.deepcopy(tomllib.loads(path.read_text(encoding="utf-8")))
    *way, last = chance.choice(list(_leaves(raw)))
    place = raw
    for key in way:
        place = place[key]
    change(place, last)
    path.write_text(tomli_w.dumps(raw), encoding="utf-8")


def leaf_replaced(path, chance):
    _edited(path, chance, lambda place, last: place.__setitem__(last, chance.choice(VALUES)))


def key_added(path, chance):
    raw = tomllib.loads(path.read_text(encoding="utf-8"))
    tables = [raw, *(value for value in raw.values() if isinstance(value, dict))]
    chance.choice(tables)["nonsense"] = 1.0
    path.write_text(tomli_w.dumps(raw), encoding="utf-8")


def key_removed(path, chance):
    _edited(path, chance, lambda place, last: place.__delitem__(last))
