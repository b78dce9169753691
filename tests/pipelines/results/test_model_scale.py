"""Every study at the scale of a wave tank, 1:70: three significant digits in print, all of them in CSV and JSON.

The inputs are those of full scale by Froude's law: lengths by λ, times and speeds by √λ, masses and forces by λ³ and so
on; so are the results, but for what comes from tables of one size, as catalogues.
"""

import contextlib
import csv
import io
import json
import math
import os
import re
import tomllib

import numpy as np
import pytest
import tomli_w

import hakobune
from hakobune.pipelines.cli import main
from hakobune.pipelines.keys.kinds import SCENES

SCALE = 1 / 70
POWERS = {  # of keys, by their names
    -0.5: "omegas",
    0.5: "speed speed_knots period periods mean_period significant_period duration wind current tsunami_period "
    "wave_period duration_hours",
    1: "cohesion_kPa dolphin depth length beam draft height freeboard width start end growth position x z diameter "
    "attachment attachment_height clearance distance spring_high spring_low surge tsunami wave_height heights "
    "amplitude anchor tide gyration clearance",
    2: "area weight_kg_per_m weight_N_per_m mass_kg_per_m",
    2.5: "damping",
    3: "displacement mass added_mass  top_tension_tonf breaking_load_tonf axial_stiffness_tonf pretension_tonf "
    "breaking_load_kN axial_stiffness_kN allowable_kN",
}
PLAIN = (
    "eccentricity drag direction_deg incidence_deg angle_deg exponent bed_friction friction added_surge added_sway "
    "added_yaw headings_deg angles_deg y beam_over_draft count acceleration coefficient drag_normal drag_tangential "
    "phase_deg allowable density gravity service_life probability ground regional averaging_s roll "
    "corner_headings_deg unit_weight_kN_per_m3 wind_driven drift_tonf_per_m2 after_segment "
    "tolerance panels block surface_drag seeds at_most window_hours"
)
POWER = {name: power for power, names in POWERS.items() for name in names.split()} | dict.fromkeys(PLAIN.split(), 0)
CHAIN = {"weight_kg_per_m": 111.3, "breaking_load_kN": 5000.0, "axial_stiffness_kN": 5e5}
MOVING = CHAIN | {"mass_kg_per_m": 128.0, "diameter": 0.15, "drag_normal": 2.0, "drag_tangential": 0.3}

ROUNDING = 1e-9  # of the largest of a quantity, which a print has as 0
LOST = re.compile(r"(?<![\d.])-?0\.0+(?![\d.])[^,;│]*")  # all its digits, which a print has as 0.00
SIZES = (1.0, 1e3, math.pi / 180, 0.01)  # of units in print, kN, ° and %


def scaled(value, name="", at=""):
    """Tables of a study at model scale"""
    if isinstance(value, dict):
        return {key: scaled(one, key, name) for key, one in value.items()}
    if isinstance(value, list):
        return [scaled(one, name, at) for one in value]
    if isinstance(value, str | bool) or name in ("factors",) or at in ("factors", "coefficients"):
        return value
    if name in ("from", "to"):
        name = at
    power = POWER[f"{at}.{name}"] if f"{at}.{name}" in POWER else POWER[name]
    return value if power == 0 else value * SCALE**power


def of(name, change=None):
    tables = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))
    if change is not None:
        change(tables)
    return tables


def few(tables):
    del tables["measured"]
    tables["waves"]["periods"]["count"] = 5


def light(tables):
    tables["types"] = {"chain": MOVING}


def cross():
    arms = {"E": (20.0, 0.0), "W": (-20.0, 0.0), "N": (0.0, 10.0), "S": (0.0, -10.0)}
    made = {"water": {"depth": 50.0}, "types": {"chain": CHAIN}, "bodies": [{"name": "barge"}]}
    made |= {"anchors": [], "fairleads": [], "lines": []}
    for name, (x, y) in arms.items():
        out = 1 + 310.0 / math.hypot(x, y)
        made["anchors"].append({"name": f"a{name}", "position": [out * x, out * y, -50.0]})
        made["fairleads"].append({"name": f"f{name}", "body": "barge", "position": [x, y, 0.0]})
        ends = {"from": f"a{name}", "to": f"f{name}"}
        made["lines"].append({"name": name, **ends, "type": "chain", "length": 330.0})
    return made


def slender(tables):
    tables["method"] = "wang"


def short(tables):
    cheap = {"memory": "constant", "dynamic_lines": "none", "qtf": "newman"}
    tables["simulation"] = {"duration_hours": 0.2, "seeds": 2} | cheap


def measured(tables):
    for key in ("maxima", "averaging_s", "family"):
        tables["wind"].pop(key)
    tables["wind"] |= {"speed": 30.0}
    for key in ("maxima", "family"):
        tables["waves"].pop(key)
    tables["waves"] |= {"height": 1.5}


COMMANDS = {  # tables of the study, keywords of the function, flags of the command
    "berth": (lambda: of("berth_tanker"), {}, ()),
    "members": (lambda: of("members_dolphin"), {}, ()),
    "passing": (lambda: of("passing_tanker", slender), {}, ()),
    "earthquake": (lambda: of("earthquake_box"), {}, ()),
    "lines": (cross, {"broken": True}, ("--broken",)),
    "line-dynamics": (lambda: of("line_chain_60m", light), {"duration": 2.4}, ("--duration", "2.4")),
    "single-point": (lambda: of("single_point_A"), {}, ()),
    "site": (lambda: of("site_bay", measured), {}, ("--output", "site.toml")),
    "breakwater": (lambda: of("breakwater_circle", few), {}, ()),
    "sections": (lambda: of("sections_hinged"), {}, ()),
}


def root(time):
    return time * SCALE**0.5


DECAY = {"time": root(np.arange(0.0, 400.0)), "motion": 2 * SCALE * np.exp(-0.004 * np.arange(400.0)) * np.cos(
    0.125 * np.arange(400.0))}  # fmt: skip
HELD = {"weight": 1000 * SCALE**2, "length": 300 * SCALE, "depth": 60 * SCALE}
SEA = {"height": 3 * SCALE, "mean_period": root(8.0)}
FENDER = {"family": "cell", "height": 2 * SCALE, "angle_deg": 8.0, "width": 2.4 * SCALE, "dolphin": 14000 * SCALE}
FLAGS = {  # command with its flags: what the function makes of the same
    f"fender --family cell --height {2 * SCALE} --angle 8 --width {2.4 * SCALE} --dolphin {14000 * SCALE} --energy "
    f"{900 * SCALE**3}": lambda: hakobune.fender(FENDER, energy=1e3 * (900 * SCALE**3)),
    f"line --weight {HELD['weight']} --length {HELD['length']} --depth {HELD['depth']} --tension "
    f"{300 * SCALE**3} --stiffness {5e5 * SCALE**3} --characteristic": lambda: hakobune.line(
        **HELD, tension=1e3 * (300 * SCALE**3), stiffness=1e3 * (5e5 * SCALE**3), characteristic=True
    ),
    f"damping decay.csv --mass {2000 * SCALE**3}": lambda: hakobune.damping("decay.csv", mass=1e3 * (2000 * SCALE**3)),
    f"sea --height {SEA['height']} --mean-period {SEA['mean_period']} --record waves.csv --duration {root(600.0)} "
    f"--step {root(0.5)} --components 60 --direction 30": lambda: hakobune.sea(
        SEA, record={"duration": root(600.0), "step": root(0.5), "components": 60, "direction": 30.0}
    ),
}
TANK = {
    "waves": "waves box.h5 --period 1.2 --heading 90 --at 0.5,-0.9",
    "moor": "moor study.toml --database box.h5",
    "response": "response study.toml --database box.h5",
}
STUDIES = {"moor": "moor_chain_12", "response": "response_box_20m"}
BOX = {"length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.6, 29.4, 32.3]}
WAVES = {"periods": {"from": 2.9, "to": 40.0, "count": 24}, "headings_deg": {"from": 0.0, "to": 330.0, "count": 12}}


@pytest.fixture
def there(tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "600")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def tank(tmp_path_factory):
    """Database of a box of 1.43 m in 0.29 m of water, and what its solution printed"""
    folder, said = tmp_path_factory.mktemp("tank"), io.StringIO()
    scene = {"tolerance": 0.01, "water": {"depth": 20.0}, "bodies": [{"shape": "box", **BOX}], "waves": WAVES}
    (folder / "box.toml").write_text(tomli_w.dumps(scaled(scene)))
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        assert main(["solve", str(folder / "box.toml"), "--output", str(folder / "box.h5")]) in (0, 1)
    return folder / "box.h5", said.getvalue()


def test_a_solution_at_model_scale_is_told_with_three_digits(tank):
    """LBd, BM = B²/12d, BM_L = L²/12d and the centre of buoyancy d/2 below the origin, where the weight is"""
    printed = numbers(re.split(r"[│┃\s,]+", tank[1]))
    length, beam, draft = 100 * SCALE, 50 * SCALE, 10 * SCALE
    by_hand = [length * beam * draft * 1.025, length * beam, *(a**2 / (12 * draft) - draft / 2 for a in (beam, length))]
    for value in by_hand:
        assert np.isclose(sorted(printed), value, rtol=2e-4, atol=0.0).any(), value
    assert not LOST.findall(tank[1].partition("body at rest")[2])


@pytest.mark.parametrize("command", COMMANDS)
def test_a_study_at_model_scale_is_printed_with_three_digits_and_kept_with_all(command, capsys, there):
    tables, keywords, flags = COMMANDS[command]
    study = scaled(tables())
    (there / "study.toml").write_text(tomli_w.dumps(study))
    made = getattr(hakobune, command.replace("-", "_"))(study, **keywords)
    compare([command, "study.toml", *flags], made, capsys)


@pytest.mark.parametrize("words", FLAGS, ids=lambda words: words.split()[0])
def test_flags_at_model_scale_are_printed_with_three_digits_and_kept_with_all(words, capsys, there):
    columns = {"delimiter": ",", "header": "time_s,motion_m", "comments": ""}
    np.savetxt("decay.csv", np.stack([*DECAY.values()], axis=1), **columns)
    compare(words.split(), FLAGS[words](), capsys)


@pytest.mark.parametrize("command", TANK)
def test_a_body_at_model_scale_is_printed_with_three_digits_and_kept_with_all(
    command, capsys, there, tank, monkeypatch
):
    monkeypatch.setattr("hakobune.pipelines.waves.result.POINTS", 21)
    (there / "box.h5").symlink_to(tank[0])
    words = TANK[command].split()
    if command == "waves":
        asked = {"period": 1.2, "heading": math.radians(90.0), "at": [(0.5, -0.9)]}
        compare(words, hakobune.waves("box.h5", **asked), capsys)
        return
    (there / "study.toml").write_text(tomli_w.dumps(scaled(of(STUDIES[command]))))
    made = getattr(hakobune, command)("study.toml", "box.h5")
    compare(words, made, capsys, {"--csv": ("--output", "found.csv"), "--json": ("--output", "found.h5")})
    lines = (there / "found.csv").read_text().splitlines(keepends=True)
    assert "".join(line for line in lines if line[0] != "#") == made.to_csv()
    assert main(["check", "found.csv"]) == 0
    found = hakobune.read("found.h5")
    assert found.quantities == made.quantities and found.told == made.told


def test_a_simulation_at_model_scale_is_printed_with_three_digits_and_kept_with_all(capsys, there, tank):
    (there / "box.h5").symlink_to(tank[0])
    (there / "study.toml").write_text(tomli_w.dumps(scaled(of("simulate_chain_12", short))))
    words = "simulate study.toml --database box.h5 --output runs.h5 --fresh"
    compare(words.split(), hakobune.simulate("study.toml", "box.h5"), capsys)


def test_hours_of_downtime_at_model_scale_are_printed_with_three_digits_and_kept_with_all(capsys, there, tank):
    """Hours of the calendar are not scaled, nor are angles and accelerations; limits stop some of the hours"""
    (there / "box.h5").symlink_to(tank[0])
    rng, n = np.random.default_rng(4), 500
    columns = {"hs [m]": SCALE * rng.lognormal(0, 0.4, n), "tp [s]": root(rng.uniform(8, 12, n))}
    columns["dir [deg]"] = rng.uniform(0, 360, n)
    times = np.datetime64("2014-01-01T00", "h") + 12 * np.arange(n)
    rows = [f"{t},{','.join(map(repr, map(float, row)))}" for t, *row in zip(times, *columns.values(), strict=True)]
    (there / "hours.csv").write_text("\n".join([f"time,{','.join(columns)}", *rows]))
    waves = {"height": "hs", "peak_period": "tp", "direction_from": "dir"}
    limits = {"heave": 0.6 * SCALE, "roll": 3.0, "bow velocity z": root(0.4)}
    made = {
        "hindcast": {"file": "hours.csv", "x_axis_compass_deg": 90.0, "waves": [waves]},
        "body": {"damping_ratio": {"roll": 0.05}},
        "points": [{"name": "bow", "position": [50 * SCALE, 0.0, 10 * SCALE]}],
        "operations": [{"name": "cranes", "limits": [{"quantity": q, "at_most": v} for q, v in limits.items()]}],
    }
    (there / "study.toml").write_text(tomli_w.dumps(made))
    found = hakobune.downtime("study.toml", "box.h5")
    assert 0 < found["downtime.hours"][0] < 8766
    compare(["downtime", "study.toml", "--database", "box.h5"], found, capsys)


def test_a_design_at_model_scale_is_printed_with_three_digits_and_kept_with_all(capsys, there, tank, monkeypatch):
    """The whole command; of its page, every number of the load cases that its table of cases has with all digits"""
    for name in ("body_pictures", "use_picture", "plans"):
        monkeypatch.setattr(f"hakobune.pipelines.design.report.{name}", lambda *given: "")
    (there / "box.h5").symlink_to(tank[0])
    study = scaled(of("moor_chain_12"))
    study = {key: value for key, value in study.items() if key not in ("waves", "wind", "current")}
    storm = {"wind": {"speed": root(30.0)}, "waves": {"height": SCALE, "period": root(7.0)}}
    states = [
        {"name": "storm", "state": "abnormal", "incidence_deg": [60.0]} | storm,
        {"name": "work", "state": "normal", "incidence_deg": [30.0], "current": {"speed_knots": root(1.0)}},
    ]
    files = {"study": "study.toml", "database": "box.h5", "service_life": 20.0, "probability": 0.8}
    rules = [{"rule": "JSCE", "subject": "chain of a multi-point mooring"}]
    project = {"project": {"name": "tank"} | files, "states": states, "rules": rules}
    for name, tables in (("study", study), ("project", project)):
        (there / f"{name}.toml").write_text(tomli_w.dumps(tables))
    words = ["design", "project.toml", "--output", "out", "--no-advice"]
    compare(words, hakobune.design("project.toml", "out", advice=False), capsys)

    page = re.sub(r"(?s)<style.*?</style>|<pre.*?</pre>", "", (there / "out" / "report.html").read_text())
    page = re.sub(r"<[^>]+>", " ", page)
    shown = np.array(sorted(numbers(re.split(r"[\s,;()]+", page))))
    rows = [line for line in (there / "out" / "cases.csv").read_text().splitlines() if not line.startswith("#")]
    cases = list(csv.DictReader(rows))
    assert len(cases) == 2
    for case in cases:
        turned = abs(float(case["yaw_deg"]))
        kept = {name: float(case[name]) for name in ("excursion_m", "largest_tension_N", "horizontal_at_anchor_N")}
        for name, value in (
            kept | {"yaw": turned, "offset": math.hypot(float(case["x_m"]), float(case["y_m"]))}
        ).items():
            size = 1e-3 if name.endswith("_N") else 1.0
            assert np.isclose(np.abs(shown), size * value, rtol=5.1e-3, atol=0.0).any(), (name, value)
    assert not LOST.findall(page)


def test_a_sweep_at_model_scale_is_printed_with_three_digits_and_kept_with_all(capsys, there):
    speeds = [root(0.1), root(0.15)]
    sweep = {"command": "berth", "study": "berth.toml", "vary": [{"key": "approach.speed", "values": speeds}]}
    for name, tables in (("berth", scaled(of("berth_tanker"))), ("sweep", sweep)):
        (there / f"{name}.toml").write_text(tomli_w.dumps(tables))
    compare(
        ["sweep", "sweep.toml", "--output", "all.h5"],
        hakobune.sweep("sweep.toml", "all.h5"),
        capsys,
        shown=("approach.energy",),
    )


def compare(words, made, capsys, outputs=None, shown=None):
    """What a command prints beside the result of its function; CSV and JSON in a pipe of 40 columns

    outputs : flags that go with a form; shown : names of what is printed, by default all that tables have
    """
    said = {}
    for form in ("", "--csv", "--json"):
        capsys.readouterr()
        os.environ["COLUMNS"] = "40" if form else "600"  # `there` puts it back
        assert main([*words, *([form] if form else []), *(outputs or {}).get(form, ())]) == made.status
        said[form] = capsys.readouterr()
    kept = json.loads(said["--json"].out.splitlines()[0])["quantities"]
    exact = numbers(cell for row in csv.reader(io.StringIO(said["--csv"].out)) for cell in row)
    printed = sorted(numbers(re.split(r"[│┃\s,]+", said[""].out)))
    for name, one in made.quantities.items():
        values = np.atleast_1d(one.values[np.isfinite(one.values)]) if one.numeric else []
        if one.record or not len(values):
            continue
        assert set(np.ravel(values).real) <= exact & set(flat(kept[name]["values"])), name
        if one.table and one.values.shape[:1] <= (40,) and (shown is None or name in shown):
            for value in values[np.abs(values) > ROUNDING * np.abs(values).max()]:
                near = np.abs(np.outer(printed, SIZES) - value) <= 5.1e-4 * abs(value)
                assert near.any(), (name, value)
    assert not LOST.findall(said[""].out + said[""].err)


def flat(values):
    """All numbers in lists of lists"""
    if isinstance(values, list):
        return [number for one in values for number in flat(one)]
    return [values]


def numbers(cells):
    found = set()
    for cell in cells:
        try:
            value = complex(cell.rstrip("%°").replace("−", "-"))
            found |= {value.real, value.imag}
        except ValueError:
            continue
    return found
