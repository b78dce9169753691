"""What is asked for and cannot be: one line that says what, which value and what is allowed, and no file."""

import os
import shlex
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import h5py
import pytest

from hakobune import pipelines
from hakobune.meshing.files import write_mesh
from hakobune.meshing.shapes import box
from hakobune.pipelines.cli import main

STUDY = (Path(pipelines.__file__).parent / "scenes" / "moor_chain_12.toml").read_text()
BOX = "box --length 100 --beam 50 --draft 10"
BODY = f"{BOX} --depth 20 --panels 24"
MASS = "--gyration 15.6,29.4,32.3"
DATABASES = {
    "full": f"{MASS} --omega 0.3,0.45,0.6,0.9 --heading 0,210,240",
    "no_drift": f"{MASS} --omega 0.3,0.45,0.6,0.9 --heading 240 --only radiation,motions",
    "no_mass": "--omega 0.6 --heading 240 --only radiation",
    "no_rao": f"{MASS} --omega 0.6 --heading 240 --only drift",
}

# command: words its one line must have, beside the name of the command
SIZES = {
    "box --length 100 --beam 50 --draft 25 --depth 20 --omega 1": ("draft is 25.0", "below the depth"),
    "box --length 100 --beam 50 --draft 20 --depth 20 --omega 1": ("draft is 20.0", "below the depth"),
    "box --length 100 --beam 50 --draft 19.99999 --depth 20 --omega 1": (
        "(depth − draft) is 1e-05 m",
        "allowed: 0.0006 m or more",
    ),
    "box --length 0 --beam 50 --draft 5 --depth 20 --omega 1": ("length is 0.0", "above 0"),
    "box --length nan --beam 50 --draft 5 --depth 20 --omega 1": ("length is nan", "above 0"),
    "box --length inf --beam 50 --draft 5 --depth 20 --omega 1": ("length is inf", "finite"),
    "box --length 1e300 --beam 50 --draft 5 --depth 20 --omega 1": ("length is 1e+300", "0.001 to 1e+06"),
    "box --length 1e-300 --beam 50 --draft 5 --depth 20 --omega 1": ("length is 1e-300", "0.001 to 1e+06"),
    "box --length 1e5 --beam 1 --draft 1 --depth 20 --omega 1": ("shortest wave is 59.8 m", "at least 500 m"),
    "box --beam 50 --draft 5 --depth 20 --omega 1": ("length is missing", "length, beam, draft"),
    "box": ("depth is missing",),
    "buoy --radius -3 --draft 5 --depth 20 --omega 1": ("radius is -3.0", "above 0"),
    f"{BODY} --omega 1 --mass nan": ("mass is nan", "above 0"),
    f"{BODY} --omega 1 --gyration 0,2,3": ("gyration is 0.0", "above 0"),
    f"{BODY} --omega 1 --center-of-gravity 0,0,nan": ("center_of_gravity is [0.0, 0.0, nan]", "three numbers"),
    f"{BODY} --omega 1 --density 1e99": ("density is 1e+99", "0.001 to 1e+06"),
    f"{BODY[:-2]} 2.5 --omega 1": ("--panels is '2.5'", "a whole number"),
}
WAVES = {
    f"{BODY} --omega 0.5,0.5": ("waves.omegas has 0.5 twice", "each value once"),
    f"{BODY} --omega ''": ("--omega is ''", "a,b,c or start:stop:count"),
    f"{BODY} --omega -1": ("waves.omegas is -1.0", "above 0"),
    f"{BODY} --omega 1e-200": ("waves.omegas is 1e-200", "1e-06 to 10000"),
    f"{BODY} --omega 0.1:2:1000000": ("count is 1000000", "2 to 10000"),
    f"{BODY} --omega 50": ("shortest wave, 0.0246 m", "give more panels"),
    f"{BODY} --period 1e-3": ("are too long for the shortest wave", "give more panels"),
    f"{BODY} --period 0": ("waves.periods is 0.0", "above 0"),
    f"{BODY} --omega 1 --heading 400": ("headings_deg has 400.0", "-360 to 360"),
    f"{BODY} --omega 1 --heading 0,360": ("headings_deg", "twice"),
    f"{BOX} --depth 20 --omega 1e4": (
        "6.16e-07 m",
        "allowed: waves of at least 0.5 m",
        "highest",
    ),
    f"{BOX} --depth 20 --omega 1e4 --method panel": (
        "panels; allowed: 20000",
        "highest",
    ),
    f"{BOX} --depth inf --omega 0.3 --method contour": ("finite water depth", "panel"),
    "box --length 100 --beam 50 --draft 1 --depth 200 --omega 0.3 --method contour": ("up to 100 times", "panel"),
    "buoy --radius 10 --draft 10 --depth 20 --omega 1 --method strip": ("'buoy'", "panel or contour"),
    f"{BOX} --depth 20 --omega 1 --method strip --only drift_force_fixed": (
        "strip does not compute",
        "panel or contour",
    ),
    f"{BOX} --depth 20 --omega 1 --method strip --only drift": ("none of which method strip computes",),
    f"{BOX} --depth 20 --omega 1 --method pressure --only added_mass_infinity": ("pressure does not compute", "panel"),
    f"{BOX} --depth 20 --omega 1 --method contour --wall -40": ("does not support a wall", "panel or pressure"),
    f"{BOX} --depth 20 --omega 1 --wall -20": ("wall is -20", "half its beam, 25"),
    f"{BOX} --depth 20 --omega 1 --wall -40 --only kochin_diffraction": ("beside a wall", "leave it out"),
    f"{BOX} --depth 20 --omega 1 --method contour --panels 300": ("no panels", "leave panels out"),
    f"{BOX} --depth 20 --omega 1 --method guess": ("method is 'guess'", "inverse-strip"),
}
MESHES = {
    "solve --mesh hole.gdf --depth 20 --omega 0.5": ("hole.gdf: the hull is open along 2 edges", "close it"),
    "solve --mesh inward.gdf --depth 20 --omega 0.5": ("inward.gdf: the normals of 8 of 8 panels", "--flip"),
    "solve --mesh mixed.gdf --depth 20 --omega 0.5": ("mixed.gdf: normals change side across 4 edges",),
    "solve --mesh above.gdf --depth 20 --omega 0.5": ("above.gdf: 3 of 8 panels above the water", "z ≤ 0"),
    "solve --mesh hole.gdf --mesh-only --output x.gdf": ("hole.gdf: the hull is open",),
    "solve --mesh nan.gdf --depth 20 --omega 0.5": ("nan.gdf, line 6: 'nan' is not a finite number",),
    "solve --mesh text.gdf --depth 20 --omega 0.5": ("text.gdf", "a GDF file"),
    "solve --mesh text.h5 --depth 20 --omega 0.5": ("text.h5: cannot read .h5", ".gdf"),
    "solve --mesh '' --depth 20 --omega 0.5": ("file is ''", "no such file"),
    "solve --mesh none.gdf --depth 20 --omega 0.5": ("none.gdf", "no such file"),
    "solve --mesh good.gdf --depth 5 --omega 0.5": ("the draft 5 m leaves 0 m of water", "more than 0"),
    "solve --mesh good.gdf --depth 20 --omega 0.5 --panels 99": ("panels is 99", "good.gdf has its own"),
}
OUTPUTS = {
    f"{BODY} --omega 1 --output .": ("is a folder",),
    f"{BODY} --omega 1 --output nowhere/x.h5": ("nowhere/x.h5 cannot be written", "the folder nowhere does not exist"),
    f"{BODY} --omega 1 --output text.h5/x.h5": ("text.h5/x.h5 cannot be written",),
    f"{BODY} --omega 1 --output text.h5": ("text.h5 is not an HDF5 file",),
    f"{BODY} --omega 1 --output text.h5 --fresh": (
        "text.h5 is not a hakobune database, so it is not replaced; give another name",
    ),
    f"{BODY} --omega 1 --output foreign.h5": ("foreign.h5 is an HDF5 file of another program",),
    f"{BODY} --omega 1 --output foreign.h5 --fresh": ("foreign.h5 is not a hakobune database",),
    f"{BODY} --omega 1 --output cut.h5": ("cut.h5 is damaged", "truncated"),
    f"{BODY} --draft 9 --omega 1 --output full.h5": ("--draft", "multiple"),
    f"{BODY} {MASS} --density 1000 --omega 1 --output full.h5": ("density was 1025.0, is 1000.0", "--fresh"),
    f"{BODY} --omega 1 --mesh-only --output nowhere/x.gdf": ("nowhere/x.gdf cannot be written",),
    f"{BODY} --omega 1 --mesh-only --output x.foo": ("cannot write .foo", ".gdf"),
    "plot full.h5 --output x.xyz": ("'.xyz'", ".png, .svg, .pdf"),
    "plot full.h5 --output x": ("''", ".png, .svg, .pdf"),
    "plot full.h5 --output nowhere/x.png": ("nowhere/x.png cannot be written",),
    "look full.h5 --plot x.xyz": ("'.xyz'", ".png"),
    "look full.h5 --plot nowhere/x.png": ("nowhere/x.png cannot be written",),
    "look full.h5": ("no display", "--plot"),
    "moor study.toml --database full.h5 --output text.h5": ("text.h5 is not a result of hakobune moor",),
    "moor study.toml --database full.h5 --output full.h5": ("full.h5 is an input of the study",),
    "moor study.toml --database full.h5 --output study.toml": ("study.toml is an input of the study",),
    "moor study.toml --database full.h5 --output nowhere/m.h5": ("nowhere/m.h5 cannot be written",),
}
LACKING = {
    "plot none.h5": ("none.h5 does not exist",),
    "check text.h5": ("text.h5 is not an HDF5 file",),
    "look foreign.h5 --plot x.png": ("HDF5 file of another program",),
    "plot cut.h5": ("cut.h5 is damaged", "truncated"),
    "look full.h5 --field hue --plot x.png": ("'hue'", "area, size, aspect, pressure"),
    "look full.h5 --field pressure --plot x.png": ("--omega rad/s and --heading degrees",),
    "look full.h5 --omega 0.6 --plot x.png": ("are for --field pressure only;",),
    "look full.h5 --field pressure --omega 0.6 --heading 0 --plot x.png": ("no pressure", "--only pressure"),
    "moor study.toml --database no_drift.h5": ("drift", "--only"),
    "moor study.toml --database no_mass.h5": ("inertia", "--gyration"),
    "moor study.toml --database no_rao.h5": ("added_mass", "must be stored", "--only motions,radiation"),
    "moor study.toml --database text.h5": ("text.h5 is not an HDF5 file",),
    "moor none.toml --database full.h5": ("none.toml does not exist",),
    "moor study.toml": ("--database",),
}
STUDIES = {  # what is replaced in the study, by what
    ("depth = 20.0", "depth = 30.0"): ("30 m of water", "20 m"),
    ("depth = 20.0", "depth = nan"): ("water.depth is nan", "above 0"),
    ("depth = 20.0", 'depth = "deep"'): ("water.depth is 'deep'", "a number"),
    ("depth = 20.0", "deep = 20.0"): ("water.deep is unknown", "depth"),
    ("[water]", "[water"): ("not TOML",),
    ("length = 100.0", "length = 110.0"): ("hull.length is 110 m", "100 m"),
    ("incidence_deg = 60.0", "incidence_deg = 6000.0"): ("incidence_deg is 6000", "360"),
    ("period = 10.0\nincidence_deg = 60.0", "period = 10.0\nincidence_deg = 270.0"): ("wave direction 90°", "heading"),
    ("period = 10.0", "period = 60.0"): ("mean period 60.12 s", "6.981 to 20.94 s"),
    ("height = 4.5", "height = -4.5"): ("waves.height is -4.5", "above 0"),
    ("speed = 50.0", "speed = inf"): ("wind.speed is inf", "finite"),
    ("length = 260.0", "length = nan"): ("spreads[0].length is nan", "above 0"),
    ("pretension_tonf = 40.0", "pretension_tonf = 0"): ("pretension_tonf is 0", "above 0"),
    ("pretension_tonf", "pretenson_tonf"): ("spreads[0].pretenson_tonf is unknown", "pretension_tonf"),
    ('type = "chain_142"', 'type = "chain_143"'): ("spreads[0].type is 'chain_143'", "chain_142"),
    ("[30, 45, 60]", "[]"): ("corner_headings_deg is empty", "one or more"),
    ("[30, 45, 60]", "[" + "45, " * 200 + "]"): ("the study has 800 lines", "up to 500", "into one"),
    ("[30, 45, 60]", "[30, 130]"): ("corner_headings_deg is 130", "0 to 90"),
    ("weight_kg_per_m = 406.0", "weight_kg_per_m = -406.0"): ("weight_kg_per_m is -406", "above 0"),
    ("weight_kg_per_m = 406.0", 'weight_kg_per_m = "light"'): ("weight_kg_per_m is text", "a number"),
    ("allowable = 0.4", "allowable = 40"): ("allowable is 40", "at most 1"),
}
FAULTS = {**SIZES, **WAVES, **MESHES, **OUTPUTS, **LACKING}


@pytest.fixture(scope="module")
def things(tmp_path_factory):
    """A folder with databases, meshes and a study, sound ones and others."""
    folder = tmp_path_factory.mktemp("things")
    for name, words in DATABASES.items():
        assert main(shlex.split(f"{BODY} {words} --output {folder / name}.h5")) == 0
    whole = (folder / "full.h5").read_bytes()
    (folder / "cut.h5").write_bytes(whole[: len(whole) // 2])
    (folder / "text.h5").write_text("my notes\n")
    with h5py.File(folder / "foreign.h5", "w") as file:
        file["x"] = 1.0
    (folder / "study.toml").write_text(STUDY)
    _write_meshes(folder)
    return folder


def _write_meshes(folder):
    mesh = box(20, 10, 5, panels=32)
    turned = mesh.whole().corners.copy()
    turned[0] = turned[0][::-1]
    for name, other in {
        "good": mesh,
        "hole": replace(mesh, corners=mesh.corners[1:]),
        "inward": mesh.flipped(),
        "above": mesh.moved(dz=1),
        "mixed": replace(mesh.whole(), corners=turned),
    }.items():
        write_mesh(other, folder / f"{name}.gdf")
    lines = (folder / "good.gdf").read_text().splitlines()
    (folder / "nan.gdf").write_text("\n".join([*lines[:5], "nan nan nan", *lines[6:]]))
    (folder / "text.gdf").write_text("my notes\n")


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.fixture
def fails(things, monkeypatch, capsys):
    """Runs a command that has to fail in one line, and to leave the folder as it was; returns the line."""

    def run(words):
        monkeypatch.chdir(things)
        monkeypatch.delenv("DISPLAY", raising=False)
        monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
        before = contents(things)
        status, said = main(words), capsys.readouterr()
        assert status == 2 and said.out == "", said
        assert said.err.startswith(f"hakobune {words[0]}: ") and said.err.count("\n") == 1, said.err
        assert contents(things) == before
        return said.err

    return run


@pytest.mark.parametrize("command", FAULTS)
def test_what_cannot_be_gives_one_line_and_no_file(command, fails):
    line = fails(shlex.split(command))
    assert all(word in line for word in FAULTS[command]), line


@pytest.mark.parametrize("change", STUDIES, ids=lambda change: change[1].splitlines()[0][:40])
def test_a_study_that_cannot_be_gives_one_line_and_no_file(change, things, fails, tmp_path):
    assert change[0] in STUDY
    study = tmp_path / "study.toml"
    study.write_text(STUDY.replace(*change, 1))
    line = fails(["moor", str(study), "--database", "full.h5", "--output", "moor.h5"])
    assert all(word in line for word in STUDIES[change]), line
    assert [path.name for path in tmp_path.iterdir()] == ["study.toml"]


def test_a_line_too_short_to_reach_its_anchor_is_named(things, fails, tmp_path):
    spreads = STUDY.index("[[spreads]]"), STUDY.index("[wind]")
    line = '[[lines]]\nname = "bow"\ntype = "chain_142"\nlength = 90.0\nfairlead = [50, 0, 0]\nanchor = [150, 0]\n\n'
    study = tmp_path / "short.toml"
    stiff = STUDY.replace("axial_stiffness_tonf", "# axial_stiffness_tonf")
    study.write_text(stiff.replace(STUDY[slice(*spreads)], line))
    said = fails(["moor", str(study), "--database", "full.h5", "--output", "moor.h5"])
    assert "line bow, inextensible and 90 m long, cannot span 101.98 m" in said


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_without_permission_is_named(things, fails, tmp_path):
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o500)
    line = fails(shlex.split(f"{BODY} --omega 1 --output {closed}/x.h5"))
    assert "no permission" in line


def test_a_database_in_use_is_neither_extended_nor_replaced(things, fails, tmp_path):
    path = tmp_path / "used.h5"
    shutil.copy(things / "full.h5", path)
    hold = f"from hakobune.bem.database import writing\nwith writing({str(path)!r}): print('open', flush=True), input()"
    with subprocess.Popen([sys.executable, "-c", hold], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        assert other.stdout.readline() == b"open\n"
        for more in ("", "--fresh"):
            line = fails(shlex.split(f"{BODY} {MASS} --omega 0.5 --output {path} {more}"))
            assert "another process has opened it" in line
        other.communicate(b"\n")


def test_a_file_of_one_long_word_is_not_told_whole(tmp_path, capsys):
    (tmp_path / "new.toml").write_text("1" * 10**6)
    assert main(["lines", str(tmp_path / "new.toml")]) == 2
    assert len(capsys.readouterr().err) < 1000
    (tmp_path / "waves.csv").write_text("1" * 10**6)
    assert main(["sea", str(tmp_path / "waves.csv")]) == 2
    assert len(capsys.readouterr().err) < 1000
