"""`hakobune response` as a person runs it, on a small database of the series box."""

import csv
import re
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from chain_study import chain_study

from hakobune import pipelines
from hakobune.bem.database import open_database
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.sea_state import sea_state
from hakobune.pipelines.cli import main
from hakobune.pipelines.response.result import without_rounding
from hakobune.pipelines.results.file import read

SCENES = Path(pipelines.__file__).parent / "scenes"
WORDS = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 60 --gyration 15.55,29.44,32.28"
STUDY = """
[sea]
height = 3.0
mean_period = 10.0
incidence_deg = 180.0
duration_hours = 2.0
[[points]]
name = "stern"
position = [-50.0, 0.0, 10.0]
clearance = 9.0
"""


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("response") / "box.h5"
    words = [*WORDS.split(), "--omega", "0.25:1.05:9", "--heading", "0,30,60,90", "--output", str(path)]
    assert main(words) == 0
    return path


@pytest.fixture
def folder(tmp_path, monkeypatch, database):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "study.toml").write_text(STUDY)
    shutil.copy(database, tmp_path / "box.h5")
    return tmp_path


def table(path):
    """{response: {statistic: text}} of the first table of a CSV"""
    text = Path(path).read_text(encoding="utf-8")
    first = "\n".join(line for line in text.splitlines() if line[:1] != "#").strip().split("\n\n")[0]
    rows = csv.DictReader(first.replace("response.", "").splitlines())
    return {row["response"].lower(): row for row in rows}


@pytest.mark.parametrize("name", ["response_box_20m", "response_climate"])
def test_every_study_that_is_shipped_runs(name, database, tmp_path, capsys):
    words = ["--output", str(tmp_path / "out.csv"), "--plot", str(tmp_path / "out.png")]
    assert main(["response", str(SCENES / f"{name}.toml"), "--database", str(database), *words]) == (
        name == "response_box_20m"
    )
    said = capsys.readouterr().out
    assert ("FAILS: air gap at port bow corner" in said) == (name == "response_box_20m")
    assert "heave, m" in said and "drift of the waves" in said and "out.csv" in said
    assert (tmp_path / "out.png").stat().st_size > 20_000
    assert {"surge", "roll", "bow acceleration z"} <= set(table(tmp_path / "out.csv"))


def test_csv_has_the_numbers_of_the_library_with_units(folder, database):
    assert main(["response", "study.toml", "--database", "box.h5", "--output", "out.csv"]) == 0
    state = sea_state(open_database(database).reader.floating(), Sea(issc(3.0, mean_period=10.0), 0.0), 7200.0)
    rows = table("out.csv")
    assert np.isclose(float(rows["heave"]["sigma"]), state.sigma[2], rtol=1e-12)
    assert rows["pitch"]["unit"] == "rad"
    assert np.isclose(float(rows["pitch"]["expected_maximum"]), state.expected_maximum[4], rtol=1e-12)
    assert "roll" not in rows  # head seas
    text = Path("out.csv").read_text(encoding="utf-8")
    assert "plane,unit,drift.mean" in text and "# air gap at stern" in text


def test_rotations_beyond_linear_theory_are_warned_of(folder, capsys):
    beam = STUDY.replace("incidence_deg = 180.0", "incidence_deg = 270.0").replace("clearance = 9.0", "clearance = 3.0")
    for height, warned in ((0.3, False), (6.0, True)):
        Path("study.toml").write_text(beam.replace("height = 3.0", f"height = {height}"))
        assert main(["response", "study.toml", "--database", "box.h5"]) == int(warned)  # water reaches the stern
        said = capsys.readouterr().out
        assert ("FAILS: air gap at stern" in said) == warned and (
            "; linear theory is valid up to about 15°, so this motion is not" in said
        ) == warned, said


def test_hdf5_has_units_at_every_number_and_the_study(folder):
    assert main(["response", "study.toml", "--database", "box.h5", "--output", "out.h5"]) == 0
    assert main(["response", "study.toml", "--database", "box.h5", "--output", "out.h5"]) == 0  # its own is replaced
    found = read("out.h5", "response")
    bare = {name for name, one in found.quantities.items() if one.numeric and not one.unit}
    assert bare == {"response.bandwidth", "air_gap.reached"}
    assert found.provenance["study"] == STUDY and found["drift.mean"].shape == (3,)
    assert found["spectrum"].shape == (len(found.labels["omega"].values), len(found.labels["response"].values))


def test_damping_of_the_study_lowers_roll(folder):
    beam = STUDY.replace("incidence_deg = 180.0", "direction_deg = 90.0")
    rolls = []
    for extra in ("", "[body]\ndamping_ratio = { roll = 0.05 }\n"):
        Path("study.toml").write_text(beam + extra)
        assert main(["response", "study.toml", "--database", "box.h5", "--output", "out.csv"]) == 0
        rolls.append(float(table("out.csv")["roll"]["sigma"]))
    assert rolls[1] < 0.9 * rolls[0]


def test_stiffness_of_the_study_holds_heave(folder):
    rows = [[1e12 if i == j == 2 else 0.0 for j in range(6)] for i in range(6)]
    heave = []
    for extra in ("", f"[body]\nstiffness = {rows}\n"):
        Path("study.toml").write_text(STUDY + extra)
        assert main(["response", "study.toml", "--database", "box.h5", "--output", "out.csv"]) == 0
        heave.append(float(table("out.csv")["heave"]["sigma"]))
    assert heave[1] < 1e-3 * heave[0]


FAULTS = [
    (("height = 3.0", "height = -1.0"), "sea.height is -1; allowed: above 0"),
    (("height = 3.0", "heigth = 3.0"), "sea.heigth is unknown, height may be meant; allowed: height"),
    (("mean_period = 10.0", ""), "no period is given; allowed: one of period, mean_period"),
    (("mean_period = 10.0", "mean_period = 10.0\npeak_period = 12.0"), "mean_period and peak_period are given"),
    (("incidence_deg = 180.0", ""), "sea: neither is given; give one of direction_deg, incidence_deg"),
    (("duration_hours = 2.0", "duration_hours = 0"), "sea.duration_hours is 0"),
    (("duration_hours = 2.0", 'spectrum = "isc"'), "sea.spectrum is 'isc'; allowed: issc"),
    (("duration_hours = 2.0", "gamma = 3.3"), "sea.gamma is given for issc"),
    (("duration_hours = 2.0", 'spreading = "cosin:4"'), "sea.spreading is 'cosin:4'; allowed: cosine:N"),
    (("clearance = 9.0", "clearance = -9.0"), r"points[0].clearance is -9"),
    (("clearance = 9.0", "[body]\ndamping_ratio = { rol = 0.1 }"), "body.damping_ratio.rol is unknown"),
    (("clearance = 9.0", "[body]\ndamping_ratio = { surge = 0.1 }"), "surge has no restoring"),
    (("clearance = 9.0", "[body]\ndamping = [[1.0]]"), "body.damping has rows of [1] numbers"),
    (("[sea]", "[climate]"), "climate"),
    (("[sea]", "[sea"), "is not TOML"),
]


@pytest.mark.parametrize(("change", "words"), FAULTS, ids=[words for _, words in FAULTS])
def test_faulty_study_is_refused_in_one_line(folder, capsys, change, words):
    assert change[0] in STUDY
    Path("study.toml").write_text(STUDY.replace(*change))
    assert main(["response", "study.toml", "--database", "box.h5", "--output", "out.csv"]) == 2
    said = capsys.readouterr().err
    assert words in said and said.count("\n") == 1
    assert not Path("out.csv").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["none.toml", "--database", "box.h5"], "none.toml does not exist"),
        (["study.toml", "--database", "none.h5"], "none.h5 does not exist"),
        (["study.toml"], "--database"),
        (
            ["study.toml", "--database", "box.h5", "--output", "out.txt"],
            "suffix '.txt'; allowed suffixes: .h5, .hdf5, .csv",
        ),
        (["study.toml", "--database", "box.h5", "--plot", "out.bmp"], "suffix '.bmp'"),
        (["study.toml", "--database", "box.h5", "--output", "box.h5"], "box.h5 is an input of the study"),
        (["study.toml", "--database", "box.h5", "--output", "nowhere/out.csv"], "nowhere"),
        (["study.toml", "--database", "study.toml"], "study.toml is not an HDF5 file"),
        ([".", "--database", "box.h5"], "cannot be read: Is a directory"),
    ],
)
def test_impossible_command_is_refused_in_one_line(folder, capsys, words, message):
    before = Path("box.h5").read_bytes()
    assert main(["response", *words]) == 2
    said = capsys.readouterr().err
    assert message in said and said.count("\n") == 1
    assert Path("box.h5").read_bytes() == before


@pytest.mark.parametrize(
    ("force", "among", "left"),
    [
        ((1e5, 1e-9, -4.9e-9), None, (1e5, 0, 0)),
        ((1e5, -2e5, 3e4), None, (1e5, -2e5, 3e4)),
        ((1e-10, 0.0, 1e-8), ((1e5, 0, 0), (-1e5, 0, 0)), (0, 0, 0)),
        ((0.0, 0.0, 0.0), None, (0, 0, 0)),
        ((3e4, np.nan, 1e-12), None, (3e4, np.nan, 0)),
        ((np.nan,) * 3, None, (np.nan,) * 3),
        ((1e-9, 2e3, np.nan), np.array([[np.nan, 2e3, 1.0]]), (0, 2e3, np.nan)),
    ],
)
def test_forces_that_are_rounding_are_zero_and_unknown_ones_stay_unknown(force, among, left):
    assert np.array_equal(without_rounding(np.array(force), 50.0, among), left, equal_nan=True)


def test_another_hdf5_file_is_not_replaced(folder, capsys):
    with h5py.File("other.h5", "w") as file:
        file["kept"] = 1.0
    assert main(["response", "study.toml", "--database", "box.h5", "--output", "other.h5"]) == 2
    assert "other.h5 is not a result of hakobune response" in capsys.readouterr().err


def test_scatter_diagram_that_is_missing_or_an_output_is_named(folder, capsys):
    Path("study.toml").write_text(
        '[climate]\nscatter = "table.csv"\ndirections = [{ direction_deg = 0, share = 1.0 }]\n'
    )
    assert main(["response", "study.toml", "--database", "box.h5"]) == 2
    assert "table.csv does not exist" in capsys.readouterr().err
    Path("table.csv").write_text("mean_period, 8, 10\n1.0, 3, 4\n2.0, 1, 2\n")
    assert main(["response", "study.toml", "--database", "box.h5", "--output", "table.csv"]) == 2
    assert "table.csv is an input of the study" in capsys.readouterr().err
    assert main(["response", "study.toml", "--database", "box.h5", "--output", "out.h5"]) == 0
    assert np.isclose(read("out.h5")["state.probability"].sum(), 1.0)


ZERO = "[0, 0, 0, 0, 0, 0]"
GAINING = ", ".join(["[-1e6, 0, 0, 0, 0, 0]"] + [ZERO] * 5)
SINKING = ", ".join([ZERO] * 2 + ["[0, 0, -1e9, 0, 0, 0]"] + [ZERO] * 3)


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("height = 3.0", "height = 25.0", "significant height is 25 m .* single waves break at .* in 20 m of water"),
        ("[[points]]", f"[body]\ndamping = [{GAINING}]\n[[points]]",
         "body.damping would add energy to surge: its damping there is -1e\\+06; allowed: at least 0"),
        ("[[points]]", f"[body]\nstiffness = [{SINKING}]\n[[points]]",
         "body.stiffness the restoring of heave is -.*, so the body does not float"),
        ("height = 3.0", 'height = 3.0\nfile = "a.csv"', "sea: both are given; give one of height, file"),
        ("mean_period = 10.0", 'mean_period = 10.0\nspectrum = "ochi_hubble"', "ochi_hubble: mean_period is given"),
    ],
    ids=["breaking", "damping", "stiffness", "two seas", "periods"],
)  # fmt: skip
def test_a_sea_or_body_that_cannot_be_is_refused_in_one_line(folder, capsys, old, new, said):
    Path("study.toml").write_text(STUDY.replace(old, new, 1))
    assert main(["response", "study.toml", "--database", "box.h5"]) == 2
    assert re.search(said, " ".join(capsys.readouterr().err.split()))


def test_wind_sea_in_shallow_water_and_a_buoys_swell_are_one_sea(folder, capsys):
    """The line names both, and heights add by energy"""
    Path("buoy.csv").write_text("frequency_hz,density_m2_hz\n0.06,0\n0.08,3.125\n0.10,0\n")
    both = """[sea]
duration_hours = 3.0
spectrum = "tma"
height = 2.0
peak_period = 9.0
direction_deg = 0.0
[[sea.swell]]
file = "buoy.csv"
direction_deg = 90.0
"""
    Path("study.toml").write_text(both)
    assert main(["response", "study.toml", "--database", "box.h5"]) == 0
    said = capsys.readouterr().out
    assert "tma spectrum, 2 m" in said and "buoy spectrum, 1 m" in said and "together 2.236 m, 3 h" in said


def test_a_climate_says_which_classes_break_and_when_water_reaches_a_point(folder, capsys):
    Path("scatter.csv").write_text("mean_period, 4, 10\n2.0, 10, 100\n4.0, 1, 20\n13.0, 0, 1\n")
    study = STUDY.replace("[sea]", '[climate]\nscatter = "scatter.csv"\nyears = 10')
    study = study.replace("height = 3.0", "").replace("mean_period = 10.0", "").replace("duration_hours = 2.0", "")
    study = study.replace("incidence_deg = 180.0", "directions = [{ direction_deg = 0, share = 1.0 }]")
    Path("study.toml").write_text(study)
    assert main(["response", "study.toml", "--database", "box.h5"]) == 1
    said = capsys.readouterr().out
    assert "FAILS: air gap at stern" in said
    assert "1 classes of the scatter diagram, 0.758 % of the time, have 2πH/gT02² above 0.1" in said
    assert "are higher than is possible in water of 20 m, such as the class of 13 m" in said
    assert re.search(
        r"air gap at stern: the rise reached once in 10 years leaves .* of 9 m; water reaches the point once in",
        said,
    )
    assert "responses do not include energy beyond the stored frequencies" in said
    assert "of the mean drift force over all time is due to waves beyond" in said


def test_water_under_the_keel_is_that_of_tide_and_draft(folder, capsys):
    """10 m at rest in 20 m of water, 2 m less by tide and draft; without water under it the study is refused"""
    study = STUDY + "[keel]\ntide = -1.5\nextra_draft = 0.5\n"
    Path("study.toml").write_text(study)
    assert main(["response", "study.toml", "--database", "box.h5"]) == 0
    said = capsys.readouterr().out
    assert re.search(
        r"under keel: the largest drop leaves .* of 8 m at keel x.*, the least of all points; the hull touches "
        r"the bed with",
        said,
    )
    assert "…" not in said and "kN" in said
    Path("study.toml").write_text(study.replace("-1.5", "-9.6"))
    assert main(["response", "study.toml", "--database", "box.h5"]) == 2
    assert (
        "there is -0.1 m of water at rest, with depth 20 m, tide -9.6 m and extra draft 0.5 m"
        in capsys.readouterr().err
    )


MOORING = f"""{chain_study([30, 60])}[wind]
speed = 20.0
incidence_deg = 180.0
gusts = "davenport"
"""


def test_a_body_on_lines_has_its_slow_motion_beside_that_of_the_waves(folder, capsys):
    Path("moor.toml").write_text(MOORING)
    damped = "[body]\ndamping_ratio = { surge = 0.05, sway = 0.05, yaw = 0.05 }\n[[points]]"
    Path("study.toml").write_text(STUDY.replace("[[points]]", damped, 1))
    words = ["response", "study.toml", "--database", "box.h5", "--moored", "moor.toml"]
    assert main([*words, "--output", "out.h5"]) == 0
    said = capsys.readouterr().out
    assert "moored, mean and slow motion" in said and "moored by 8 lines of moor.toml: steady forces Fx" in said
    assert "gusts of" in said and "drift of the waves" in said and "air gap at stern" in said
    found = read("out.h5")
    slow, fast = found["moored[surge].slow"], found["moored[surge].wave"]
    assert found["moored[surge].largest"] > abs(found["moored[surge].offset"]) + 2 * np.hypot(slow, fast)
    damping = found["moored.damping"]
    Path("study.toml").write_text(STUDY)
    assert main([*words, "--output", "less.h5"]) == 0
    less = read("less.h5")["moored.damping"]  # the drag of the hull alone
    assert np.all(less > 0) and np.allclose(damping - less, 0.05, atol=0.005)
