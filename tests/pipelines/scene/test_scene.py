"""What a scene says, and what it must not say."""

import resource
import subprocess
import sys
import tomllib

import numpy as np
import pytest
from box_scene import SCENE

from hakobune.pipelines.cli import main
from hakobune.pipelines.common.typed import to_toml
from hakobune.pipelines.scene.products import GROUPS, expand
from hakobune.pipelines.scene.scene import SceneError, make_scene, numbers, read_scene

# what is replaced by what, and words the one line must have
FAULTS = {
    "unknown key": ("depth = 20.0", "deepth = 20.0", ("water.deepth is unknown", "depth, density, gravity")),
    "text for a number": ("depth = 20.0", 'depth = "deep"', ("water.depth is 'deep'", "a number")),
    "negative depth": ("depth = 20.0", "depth = -20.0", ("water.depth", "-20.0", "above 0")),
    "zero depth": ("depth = 20.0", "depth = 0.0", ("water.depth", "0.0", "above 0")),
    "depth is NaN": ("depth = 20.0", "depth = nan", ("water.depth", "nan")),
    "no depth": ("depth = 20.0", "", ("water.depth is missing", "--depth", "depth under [water]")),
    "no water": ("[water]\ndepth = 20.0", "", ("water.depth is missing", "--depth", "depth under [water]")),
    "aground": ("depth = 20.0", "depth = 10.0", ("draft", "10.0", "below the depth")),
    "negative density": ("depth = 20.0", "depth = 20.0\ndensity = -1.0", ("water.density", "-1.0")),
    "infinite gravity": ("depth = 20.0", "depth = 20.0\ngravity = inf", ("water.gravity", "inf")),
    "zero length": ("length = 100.0", "length = 0", ("bodies[0].length", "above 0")),
    "infinite beam": ("beam = 50.0", "beam = inf", ("bodies[0].beam", "inf")),
    "no draft": ("draft = 10.0", "", ("bodies[0].draft", "missing", "length, beam, draft")),
    "radius of a box": ("draft = 10.0", "draft = 10.0\nradius = 3.0", ("bodies[0].radius", "3.0")),
    "unknown shape": ('"box"', '"bowl"', ("shape", "bowl", "box, buoy, ship, mesh")),
    "a body among others without name": (
        "[waves]",
        '[[bodies]]\nshape = "buoy"\nradius = 3.0\ndraft = 2.0\n[waves]',
        ("bodies[0].name", "None"),
    ),
    "no such mesh file": (
        'shape = "box"\nlength = 100.0\nbeam = 50.0\ndraft = 10.0',
        'shape = "mesh"\nfile = "no.gdf"',
        ("bodies[0].file", "no.gdf"),
    ),
    "two radii": ("[15.0, 29.0, 32.0]", "[15.0, 29.0]", ("gyration",)),
    "negative radius": ("[15.0, 29.0, 32.0]", "[15.0, -29.0, 32.0]", ("gyration", "-29.0")),
    "negative mass": ("draft = 10.0", "draft = 10.0\nmass = -5.0", ("mass", "-5.0")),
    "no frequencies": ("omegas = [0.4, 0.8]", "", ("waves", "omegas, periods, xi_B")),
    "empty list": ("omegas = [0.4, 0.8]", "omegas = []", ("waves.omegas", "0 values")),
    "two lists": ("omegas = [0.4, 0.8]", "omegas = [0.4]\nperiods = [8]", ("omegas and periods",)),
    "zero frequency": ("omegas = [0.4, 0.8]", "omegas = [0.0, 0.8]", ("waves.omegas", "0.0", "above 0")),
    "infinite frequency": ("omegas = [0.4, 0.8]", "omegas = [0.4, inf]", ("waves.omegas", "inf")),
    "frequency twice": ("omegas = [0.4, 0.8]", "omegas = [0.4, 0.8, 0.4]", ("waves.omegas", "0.4", "twice")),
    "backward span": ("[0.4, 0.8]", "{ from = 1.0, to = 0.5, count = 3 }", ("waves.omegas", "from 1.0")),
    "span of one": ("[0.4, 0.8]", "{ from = 0.1, to = 0.5, count = 1 }", ("waves.omegas", "count is 1")),
    "heading too far": ("[0, 45]", "[0, 450]", ("headings_deg", "450")),
    "heading is NaN": ("[0, 45]", "[0, nan]", ("headings_deg", "nan")),
    "heading twice": ("[0, 45]", "[45, 405.0, -315]", ("headings_deg",)),
    "same heading": ("[0, 45]", "[0, 360]", ("headings_deg", "twice")),
    "headings nearly the same": ("[0, 45]", "[0, 1e-13]", ("headings_deg has 0 twice", "1e-13")),
    "headings nearly a turn apart": ("[0, 45]", "[0, 359.99999999999]", ("headings_deg has 0 twice",)),
    "frequencies nearly the same": ("omegas = [0.4, 0.8]", "omegas = [0.4, 0.4000000005]", ("waves.omegas", "twice")),
    "periods nearly the same": ("omegas = [0.4, 0.8]", "periods = [5.0, 5.000000005]", ("waves.periods", "twice")),
    "xi_B nearly the same": ("omegas = [0.4, 0.8]", "xi_B = [0.5, 0.5000000015]", ("waves.xi_B", "twice")),
    "no headings": ("[0, 45]", "[]", ("headings_deg", "0 values")),
    "tolerance too fine": ("tolerance = 0.01", "tolerance = 1e-9", ("tolerance", "1e-09")),
    "no panels": ("tolerance = 0.01", "panels = 0", ("panels", "0")),
    "unknown method": ("tolerance = 0.01", 'method = "magic"', ("method", "magic", "auto, panel")),
    "unknown product": ("tolerance = 0.01", 'want = ["drfit"]', ("drfit", "drift")),
    "empty want": ("tolerance = 0.01", "want = []", ("want", "empty")),
    "not TOML": ("[water]", "[water", ("not TOML",)),
    "water is a number": ("[water]\ndepth = 20.0", "water = 3.0", ("water", "3.0")),
}


def scene(old="", new=""):
    assert old in SCENE
    return make_scene(tomllib.loads(SCENE.replace(old, new)))


@pytest.mark.parametrize("fault", FAULTS)
def test_a_bad_scene_gives_one_line_with_key_and_value_and_no_file(fault, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    old, new, words = FAULTS[fault]
    assert old in SCENE
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.replace(old, new, 1))
    status = main(["solve", str(file), "--output", "out.h5"])
    said = capsys.readouterr()
    assert status == 2 and said.out == ""
    assert said.err.startswith("hakobune solve: ") and said.err.count("\n") == 1, said.err
    assert all(word in said.err for word in words), said.err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scene.toml"]


BOX = ["box", "--length", "100", "--beam", "50", "--draft", "10", "--depth", "20", "--omega", "0.5"]
BAD_FLAGS = {
    "unknown flag": ([*BOX, "--lenght", "3"], "--lenght"),
    "not a number": ([*BOX, "--density", "heavy"], "heavy"),
    "not a list": ([*BOX, "--heading", "a,b"], "--heading is 'a,b'"),
    "not a span": ([*BOX, "--heading", "0:90"], "start:stop:count"),
    "two numbers": ([*BOX, "--gyration", "1,2"], "--gyration is '1,2'"),
    "negative draft": ([*BOX[:5], "--draft", "-10", *BOX[7:]], "bodies[0].draft is -10.0"),
    "both kinds": ([*BOX, "--period", "8"], "--omega and --period"),
    "no frequency": (BOX[:-2], "no frequencies"),
    "unknown name": ([*BOX, "--only", "drfit"], "drfit"),
    "motions without mass": ([*BOX, "--only", "rao"], "--gyration"),
    "unknown method": ([*BOX, "--method", "strips"], "'strips'"),
    "unknown executor": ([*BOX, "--executor", "cloud"], "local, processes:N"),
    "no depth": ([*BOX[:7], *BOX[9:]], "water.depth is missing; allowed: above 0 m, or inf; give --depth"),
    "wall is NaN": ([*BOX, "--wall", "nan"], "wall is nan; allowed: a number from -1e+06 to 1e+06"),
    "empty output": ([*BOX, "--output", ""], "--output: '' is empty; allowed: the name of a file"),
    "no folder": ([*BOX, "--output", "nowhere/box.h5"], "the folder nowhere does not exist"),
    "no scene file": (["solve", "none.toml"], "none.toml does not exist"),
    "nothing": (["solve"], "scene file or --mesh"),
    "unknown command": (["fly"], "fly"),
    "no database": (["plot", "none.h5"], "none.h5 does not exist"),
    "no file to check": (["check", "none.h5"], "none.h5 does not exist"),
}


@pytest.mark.parametrize("fault", BAD_FLAGS)
def test_a_bad_command_gives_one_line_and_no_file(fault, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    arguments, words = BAD_FLAGS[fault]
    status = main(arguments)
    said = capsys.readouterr()
    assert status == 2
    assert said.err.startswith("hakobune") and said.err.count("\n") == 1, said.err
    assert words in said.err
    assert list(tmp_path.iterdir()) == []


def test_text_of_a_scene_reads_back_as_the_same_scene():
    for one in (scene(), scene("depth = 20.0", "depth = inf"), scene("[0.4, 0.8]", "{from=0.1, to=2.0, count=5}")):
        assert make_scene(tomllib.loads(to_toml(one))) == one


def test_names_of_files_are_text_whatever_is_in_them(tmp_path):
    file = tmp_path / 'a "hull"\nof\ttwo \\ lines é #1.gdf'
    file.write_text("")
    raw = {"water": {"depth": 9.0}, "bodies": [{"shape": "mesh", "file": str(file)}], "waves": {"omegas": [1.0]}}
    assert make_scene(tomllib.loads(to_toml(make_scene(raw)))) == make_scene(raw)


def test_a_mesh_file_is_looked_for_beside_its_scene(tmp_path):
    (tmp_path / "scene.toml").write_text('[[bodies]]\nshape = "mesh"\nfile = "hull.gdf"\n')
    assert read_scene(tmp_path / "scene.toml")["bodies"][0]["file"] == str(tmp_path / "hull.gdf")


def test_periods_and_box_numbers_are_frequencies():
    np.testing.assert_allclose(
        scene("omegas = [0.4, 0.8]", "periods = [5, 10]").omegas(), 2 * np.pi / np.array([10, 5])
    )
    xi = scene("omegas = [0.4, 0.8]", "xi_B = [0.5, 2.0]").omegas() ** 2 * 50 / (2 * 9.80665)
    np.testing.assert_allclose(xi, [0.5, 2.0])


def test_numbers_are_lists_or_spans():
    assert numbers("x", "1,2.5") == [1.0, 2.5]
    assert numbers("x", "0:2:5") == {"from": 0.0, "to": 2.0, "count": 5}
    for text in ("", "1,", "1:2", "1:2:3:4", "1:2:2.5"):
        with pytest.raises(SceneError, match="start:stop:count"):
            numbers("x", text)


def test_groups_are_made_of_names_and_motions_need_inertia():
    everything = expand(None, motions_known=True)
    assert set(everything) == {name for names in GROUPS.values() for name in names}
    assert set(everything) - set(expand(None, motions_known=False)) == {"rao", "drift_force", "body_drift_force"}
    assert expand(["drift"], motions_known=False) == ("drift_force_fixed", "body_drift_force_fixed")
    with pytest.raises(ValueError, match="gyration"):
        expand(["drift_force"], motions_known=False)


def processor_time(*arguments):
    """s, because this machine may be busy with something else"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def test_help_answers_at_once():
    """Without any of what solves, and before the compiler alone would be loaded"""
    assert processor_time("-m", "hakobune.pipelines.cli", "--help") < processor_time("-c", "import numba")
    asked = (
        "import sys; from hakobune.pipelines.cli import main; sys.argv = ['hakobune', '--help']\ntry: main()\nfinally: "
    )
    loaded = (
        "print(*sorted({'numpy', 'numba', 'scipy', 'gmsh', 'h5py', 'matplotlib'} & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", asked + loaded], capture_output=True, text=True)
    assert "--help" in done.stdout and not done.stderr.strip()


def test_a_band_in_a_scene_may_be_written_as_its_flag_has_it():
    box = {"shape": "box", "length": 50.0, "beam": 20.0, "draft": 4.0}
    raw = {"water": {"depth": 20.0}, "bodies": [box], "waves": {"omegas": "auto:0.2:1.2", "headings_deg": [0, 90]}}
    scene = make_scene(raw)
    assert (scene.waves.band.first, scene.waves.band.last, scene.waves.omegas) == (0.2, 1.2, None)
    assert scene.waves.headings_deg == [0, 90] and raw["waves"]["omegas"] == "auto:0.2:1.2"
    with pytest.raises(SceneError, match=r"waves.omegas is 'auto'; allowed: auto:from:to in rad/s"):
        make_scene(raw | {"waves": {"omegas": "auto"}})
