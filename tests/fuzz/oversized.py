"""Inputs that ask for more than any machine has: each a fixed case (what, command line, what is done to the folder)."""

from __future__ import annotations

import os
import tomllib
from itertools import pairwise
from pathlib import Path

import numpy as np
import tomli_w

BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --omega 0.5 --heading 0 --output new.h5"
BUOY = "buoy --radius 10 --draft 10 --depth 30 --omega 0.5 --heading 0 --output new.h5"
SEA = "sea --height 3 --mean-period 8"
SPAN = "0:1:1000000000"
MANY = ",".join(f"{x:.9f}" for x in np.linspace(0.1, 2.0, 9000))  # of a command line
FLAGS = (  # command lines alone
    f"{BOX} --omega {SPAN}",
    BOX.replace("--omega 0.5", "--period 1:2:1000000000"),
    f"{BOX} --heading {SPAN}",
    f"{BOX} --omega 0.1:1.0:10000 --heading -180:179:10000",
    f"{BOX} --omega {MANY}",
    f"{BOX} --panels 1000000000",
    f"{BOX} --panels 100000",
    f"{BOX} --panels 60000 --method panel",
    f"{BOX} --tolerance 1e-5 --method panel --omega 5",
    f"{BOX} --omega auto:0.001:100",
    f"{BOX} --executor processes:1000000000",
    f"{BOX} --executor processes:100000",
    f"{BOX} --length 1e6 --beam 10",
    f"{BOX} --length 1e6 --beam 10 --panels 5000 --omega 0.001",
    f"{BOX} --length 1e6 --beam 1e6 --omega 1",
    f"{BOX} --length 1e-3 --beam 1e6 --omega 1",
    f"{BOX} --omega 1e4",
    f"{BOX} --depth 10.0000001",
    f"{BOX} --depth 10.0000001 --method panel",
    f"{BOX} --mesh-only --panels 100000 --output new.msh",
    f"{BUOY} --panels 1000000000",
    f"{BUOY} --radius 1e5 --draft 1e-3",
    f"{BUOY} --radius 1e-3 --draft 29",
    f"{BUOY} --mesh-only --panels 1000000000 --output new.gdf",
    f"{SEA} --record new.csv --duration 1e12",
    f"{SEA} --record new.csv --duration 1e12 --step 1e11",
    f"{SEA} --record new.csv --duration 1e6 --step 0.1",
    f"{SEA} --record new.csv --components 1000000000",
    f"{SEA} --record new.csv --components 1000000000000000000000",
    f"{SEA} --record new.csv --components 5000000 --duration 60",
    f"{SEA} --record new.csv --amplitudes random --duration 1e7 --step 1",
    f"{SEA} --record new.csv --seed {'9' * 5000}",
    f"{SEA} --record new.csv --step 1e-12",
    f"{SEA} --record new.csv --spreading cosine:1000000000",
    f"{SEA} --record new.csv --components 100000 --spreading mitsuyasu:75 --duration 60",
    f"{SEA} --record new.csv --point 1e300,1e300",
    "sea waves.csv --segment 1e12",
    "sea waves.csv --segment 1e-12",
    "sections --beam-draft 0.1:100:1000000000 --depth-draft 2 --xi 1 --output new.csv",
    "sections --beam-draft 5 --depth-draft 1.1:2:1000000000 --xi 1",
    "sections --beam-draft 5 --depth-draft 2 --xi 0.1:1:1000000000",
    "sections --beam-draft 1:10:1000 --depth-draft 1.1:2:1000 --xi 0.1:1:1000",
    f"sections --beam-draft 5 --depth-draft 2 --xi {MANY} --tolerance 1e-8",
    "sections --beam-draft 1e9 --depth-draft 1.000000001 --xi 1e9 --tolerance 1e-8",
    "sections --beam-draft 1e-9 --depth-draft 1e9 --xi 1e-9 --tolerance 1e-8",
    "sections --beam-draft 5 --depth-draft inf --xi 1e9",
    f"compare depth-series --xi {SPAN}",
    "compare depth-series --xi 0.1:1:10000",
    "compare models --xi 1e-12,1e12",
    "stress --scenes 1000000000000",
    f"stress --scenes {'9' * 5000}",
    "stress --scenes 5 --first 1000000000000000000000000",
    "stress --scenes 5 --executor processes:1000000",
    "bench --threads 1000000000",
    "bench --threads " + ",".join(map(str, range(1, 5000))),
    "line --weight 1000 --stiffness 1e6 --length 1e300 --depth 20 --span 90",
    "line --weight 1e-300 --stiffness 1e300 --length 100 --depth 20 --span 90",
    "line --weight 1000 --stiffness 1e6 --length 1e9 --depth 1e8 --span 90",
    "line --weight 1000 --length 100 --depth 20 --tension 1e300",
    "lines system.toml --offset 1e9",
    f"lines system.toml --offset 1 --direction {','.join(['1'] * 20000)}",
    "lines system.toml --force 1e300,0,0",
    "line-dynamics line.toml --duration 1e12 --output new.h5",
    "line-dynamics line.toml --duration 1e7 --output new.h5",
    "line-dynamics line.toml --tolerance 1e-300",
    "line-dynamics line.toml --tolerance 1e-14 --duration 100",
    "look box.h5 --omega 1e300 --field pressure --plot new.png",
)


def _toml(name, change):
    """Changes a TOML file of the folder: change(tables)"""

    def spoil(folder):
        path = Path(folder, name)
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
        change(raw)
        path.write_text(tomli_w.dumps(raw), encoding="utf-8")

    return spoil


def _text(name, text):
    def spoil(folder):
        path = Path(folder, name)
        path.unlink(missing_ok=True)
        path.write_bytes(text() if callable(text) else text)

    return spoil


def _sparse(name, size):
    """A file of so many bytes, zeros that take no room"""

    def spoil(folder):
        with Path(folder, name).open("ab") as file:
            file.truncate(size)

    return spoil


def _pipe(name):
    def spoil(folder):
        Path(folder, name).unlink(missing_ok=True)
        os.mkfifo(Path(folder, name))

    return spoil


def _link(name, target):
    def spoil(folder):
        Path(folder, name).unlink(missing_ok=True)
        Path(folder, name).symlink_to(target)

    return spoil


def _set(*way):
    """Change of the value at keys and places; the last of `way` is the new one"""
    *way, last, value = way

    def change(raw):
        for key in way:
            raw = raw[key]
        raw[last] = value

    return change


READERS = {  # what reads a file of this name
    "scene.toml": "solve scene.toml --output new.h5",
    "mesh.gdf": "solve --mesh mesh.gdf --depth 20 --omega 0.5 --heading 0 --output new.h5",
    "mesh.ply": "look mesh.ply --plot new.png",
    "mesh.vtu": "look mesh.vtu --plot new.png",
    "mesh.pnl": "look mesh.pnl --plot new.png",
    "mesh.nemoh": "look mesh.nemoh --plot new.png",
    "box.h5": "check box.h5",
    "moor.toml": "moor moor.toml --database box.h5 --output new.h5",
    "response.toml": "response response.toml --database box.h5 --output new.csv",
    "response_climate.csv": "response climate.toml --database box.h5 --output new.csv",
    "system.toml": "lines system.toml",
    "system.dat": "lines system.dat --depth 20",
    "system.yaml": "lines system.yaml --depth 20",
    "line.toml": "line-dynamics line.toml --duration 20",
    "waves.csv": "sea waves.csv",
    "spectrum.csv": "sea --table spectrum.csv",
    "new.csv": "check new.csv",
    "run.h5": "lines run.h5",
}
MORE = {  # other readers of the same
    "box.h5": (
        "plot box.h5 --output new.png",
        "look box.h5 --plot new.png",
        "moor moor.toml --database box.h5",
        "response response.toml --database box.h5",
        "lines system.toml --database box.h5",
        "solve scene.toml --output box.h5",
        "check box.h5 --repair",
    ),
    "waves.csv": ("check waves.csv",),
}


def _of_files():
    for name, line in READERS.items():
        for words in (line, *MORE.get(name, ())):
            yield f"/dev/zero as {name}: {words}", words, _link(name, "/dev/zero")
            yield f"/dev/stdin as {name}: {words}", words, _link(name, "/dev/stdin")
            yield f"a pipe as {name}: {words}", words, _pipe(name)
            yield f"itself as {name}: {words}", words, _link(name, name)
        yield f"1 TB as {name}", line, _sparse(name, 10**12)
        yield f"200 MB of zeros as {name}", line, _sparse(name, 2 * 10**8)
        yield f"100 MB of digits as {name}", line, _text(name, lambda: b"1" * 10**8)
        yield f"10 000 nested lists in {name}", line, _text(name, b"a = " + b"[" * 10_000 + b"]" * 10_000)
        yield f"10 000 nested tables in {name}", line, _text(name, b"[" + b"a." * 10_000 + b"a]\nb = 1\n")


def _of_meshes():
    """Counts in the head of a file that its body does not hold, and panels that are too thin or too many"""
    head = b"ply\nformat %s 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
    faces = b"element face %d\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n"
    look = READERS["mesh.ply"]
    for form in (b"ascii", b"binary_little_endian", b"binary_big_endian"):
        for count in (10**9, 10**11, 10**30):
            for points, panels in ((count, 5), (1, count)):
                content = head % (form, points) + faces % panels
                yield f"ply, {form.decode()}, {points:.0e} points, {panels:.0e} faces", look, _text("mesh.ply", content)
    garbage = head % (b"binary_little_endian", 99) + faces % 99 + bytes(range(256)) * 99
    yield "ply of garbage", look, _text("mesh.ply", garbage)
    lists = b"ply\nformat ascii 1.0\nelement vertex 9999999\nproperty list uchar int a\nend_header\n"
    yield "ply with lists for points", look, _text("mesh.ply", lists)
    for name, content in HEADS:
        yield f"{name} that begins {content[:40]!r}", f"look {name} --plot new.png", _text(name, content)
    for words in (READERS["mesh.gdf"], "look mesh.gdf --plot new.png"):
        for ratio in (1e3, 1e5, 1e7, 1e9):
            yield f"panels of {ratio:g} to 1: {words}", words, _text("mesh.gdf", _box_with_slivers(ratio))
        for count in (10_000, 400_000):
            yield f"mesh of {count} panels: {words}", words, _text("mesh.gdf", lambda count=count: _plate(count))


_VTK = b"# vtk DataFile Version 3.0\na\n%s\nDATASET UNSTRUCTURED_GRID\nPOINTS 100000000000 double\n"
_ENTITY = b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY a "%s">]><VTKFile>%s</VTKFile>'
_PIECE = b'<Piece NumberOfPoints="100000000000" NumberOfCells="1000000000000"></Piece>'
HEADS = (
    ("mesh.stl", b"\0" * 80 + (4_000_000_000).to_bytes(4, "little")),
    ("mesh.off", b"OFF\n1000000000 1000000000 0\n0 0 0\n"),
    ("mesh.obj", b"v 0 0 0\nf 1 1000000000 1000000000000000000000\n"),
    ("mesh.vtk", _VTK % b"ASCII"),
    ("mesh.vtk", _VTK % b"BINARY"),
    ("mesh.msh", b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 100000000000 1 100000000000\n"),
    ("mesh.msh", b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n100000000000\n1 0 0 0\n"),
    ("mesh.msh", b"$MeshFormat\n4.1 1 8\n\1\0\0\0$EndMeshFormat\n$Nodes\n" + (10**11).to_bytes(8, "little") * 4),
    ("mesh.pnl", b"a\n 1000000000 1000000000 0 0\n"),
    ("mesh.nemoh", b"2 0\n1 0 0 0\n0 0 0 0\n1 2 3 1000000000\n"),
    ("mesh.gdf", b"a\n1 9.8\n0 0\n1000000000000\n0 0 0\n"),
    ("mesh.vtu", _ENTITY % (b"b" * 100_000, b"&a;" * 100_000)),
    ("mesh.vtu", b'<VTKFile type="UnstructuredGrid"><UnstructuredGrid>%s</UnstructuredGrid></VTKFile>' % _PIECE),
    ("mesh.vtu", b"<a>" * 100_000),
)


def _gdf(panels):
    rows = "".join(f"{x:.12g} {y:.12g} {z:.12g}\n" for panel in panels for x, y, z in panel)
    return f"made up\n1 9.8\n0 0\n{len(panels)}\n{rows}".encode()


def _box_with_slivers(ratio):
    """A box of 10 m whose sides and bottom are cut into a thick strip and one that is thin in this ratio"""
    thin, panels = 10 / ratio, []
    for low, high in ((-5, 5 - thin), (5 - thin, 5)):
        panels.append([(low, -5, -5), (low, 5, -5), (high, 5, -5), (high, -5, -5)])
        for y, turn in ((-5, 1), (5, -1)):
            panels.append([(low, y, -5), (high, y, -5), (high, y, 0), (low, y, 0)][::turn])
    for x, turn in ((-5, -1), (5, 1)):
        panels.append([(x, -5, -5), (x, 5, -5), (x, 5, 0), (x, -5, 0)][::turn])
    return _gdf(panels)


def _plate(count):
    """A plate of so many panels under water"""
    x, y = np.linspace(0, 10, 101), np.linspace(0, 10, count // 100 + 1)
    strips = [(a, b, c, d) for a, b in pairwise(x) for c, d in pairwise(y)]
    return _gdf([[(a, c, -2), (a, d, -2), (b, d, -2), (b, c, -2)] for a, b, c, d in strips])


def _of_studies():
    yield from _of_responses()
    yield from _of_lines()
    moor = READERS["moor.toml"]
    for count in (1000, 20_000):
        yield f"{count} spreads of lines", moor, _toml("moor.toml", _repeated("spreads", count))
        angles = np.linspace(1, 89, count).tolist()
        yield f"{count} lines of a spread", moor, _toml("moor.toml", _set("spreads", 0, "corner_headings_deg", angles))
    solve, omegas = READERS["scene.toml"], np.linspace(0.1, 2, 200_000).tolist()
    yield "200 000 frequencies in a scene", solve, _toml("scene.toml", _set("waves", "omegas", omegas))
    yield "10 000 bodies in a scene", solve, _toml("scene.toml", _repeated("bodies", 10_000))
    rows = b"".join(b"%d,%d\n" % (i, i % 7) for i in range(1, 10**7))
    yield "a record of 10 million values", "sea waves.csv", _text("waves.csv", b"time_s,elevation_m\n" + rows)
    yield "a record without times of 60 million values", "sea waves.csv --step 0.1", _text("waves.csv", _ups_and_downs)
    yield "a row of 10 million columns", "sea waves.csv", _text("waves.csv", lambda: b"1," * 10**7 + b"1\n")
    content = b"omega_rad_s,density_m2_s_rad\n" + b"".join(b"%d,1\n" % i for i in range(1, 10**6))
    yield "a spectrum of a million rows", "sea --table spectrum.csv", _text("spectrum.csv", content)


def _ups_and_downs():
    return b"1\n-1\n" * 3 * 10**7


def _of_responses():
    response, climate = READERS["response.toml"], READERS["response_climate.csv"]
    heights, periods = np.linspace(0.1, 20, 3200), np.linspace(3, 20, 3200)

    def classes(n):
        def spoil(folder):
            head = "mean_period," + ",".join(f"{period:.4f}" for period in periods[:n])
            rows = (f"{height:.4f}," + ",".join(["1"] * n) for height in heights[:n])
            _text("response_climate.csv", "\n".join([head, *rows]).encode())(folder)
            long_crested([{"direction_deg": 0.0, "share": 1.0}])(folder)

        return spoil

    def long_crested(directions):
        def change(raw):
            raw["climate"]["directions"] = directions
            raw["climate"].pop("spreading", None)

        return _toml("climate.toml", change)

    for n in (300, 1000, 3200):
        yield f"climate of {n * n} classes", climate, classes(n)
    directions = [{"direction_deg": i % 60, "share": 1e-5} for i in range(100_000)]
    yield "100 000 directions", climate, long_crested(directions)
    yield "climate of 1e300 years", climate, _toml("climate.toml", _set("climate", "years", 1e300))
    for count in (1000, 10_000, 1_000_000):
        points = [{"name": f"p{i}", "position": [0.0, 0.0, float(i)]} for i in range(count)]
        yield f"{count} points", response, _toml("response.toml", _set("points", points))
        yield f"{count} points in a climate", climate, _toml("climate.toml", _set("points", points))


def _of_lines():
    line, lines = "line-dynamics line.toml --output new.h5", "lines system.toml --output new.h5"
    for elements in (1000, 100_000, 10**9, 10**18):
        change = _set("segments", 0, "elements", elements)
        yield f"{elements:.0e} elements of a line", f"{line} --duration 20", _toml("line.toml", change)
    for key, value in (("frames", 10**9), ("frames", 100_000), ("measure_from", 1e300), ("duration", 1e15)):
        yield f"{key} {value:g} of a line", line, _toml("line.toml", _set(key, value))
    for period in (1e-9, 1e-4, 1e9):
        motion = [{"amplitude": [0.01, 0.0, 0.0], "period": period}]
        yield f"motion of {period:g} s", line, _toml("line.toml", _set("fairlead", "motions", motion))
    motions = [{"amplitude": [1e-4, 0.0, 0.0], "period": 10.0 + i} for i in range(10_000)]
    change = _set("fairlead", "motions", motions)
    yield "10 000 motions", f"{line} --duration 12000", _toml("line.toml", change)
    yield "100 000 segments", f"{line} --duration 20", _toml("line.toml", _repeated("segments", 100_000))
    for count in (200, 3000, 100_000):
        for words in (lines, "lines system.toml --broken --offset 1"):
            yield f"{count} lines: {words}", words, _toml("system.toml", lambda raw, n=count: _more_lines(raw, n))
    for count in (50, 200, 3000, 100_000):
        yield f"{count} free points", lines, _toml("system.toml", lambda raw, n=count: _more_points(raw, n))


def _more_lines(raw, count):
    raw["lines"] = [{**raw["lines"][i % 2], "name": f"line {i}"} for i in range(count)]


def _more_points(raw, count):
    """A line cut by so many sinkers"""
    whole, other = raw["lines"]
    raw["points"] = [{"name": f"p{i}", "position": [1.0 * i, 0.0, -5.0], "mass": 100.0} for i in range(count)]
    ends = [whole["from"], *(point["name"] for point in raw["points"]), whole["to"]]
    parts = [
        {"name": f"part {i}", "type": whole["type"], "length": whole["length"] / (count + 1), "from": a, "to": b}
        for i, (a, b) in enumerate(pairwise(ends))
    ]
    raw["lines"] = [*parts, other]


def _repeated(key, count):
    def change(raw):
        raw[key] = raw[key] * count

    return change


def _once(words):
    """The words of a command line in which the last of equal flags counts"""
    kept = words[:1]
    for i, word in enumerate(words[1:], 1):
        if word.startswith("--") and word in words[i + 1 :]:
            continue
        if words[i - 1].startswith("--") and words[i - 1] in words[i:]:
            continue
        kept.append(word)
    return kept


def oversized():
    """(what, words, spoil) of every case"""
    for line in FLAGS:
        words = _once(line.split())
        yield " ".join(words)[:200], words, lambda folder: None
    for part in (_of_files, _of_meshes, _of_studies):
        for what, line, spoil in part():
            yield what, line.split(), spoil
