"""Which parts of a study go where, with the physics replaced: passing ships, sweeps, runs, weights, problems."""

from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.passing import double_body as panels
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime import answers
from hakobune.pipelines.exchange import weighing
from hakobune.pipelines.passing import result as passing
from hakobune.pipelines.scene import modes
from hakobune.pipelines.scene.scene import SceneError
from hakobune.pipelines.simulate import command as simulate
from hakobune.pipelines.solve import plan, problem
from hakobune.pipelines.sweep import command as sweep


@pytest.mark.parametrize("method", ["panels", "wang", "kriebel"])
@pytest.mark.parametrize("given", [None, (5.0, 6.0, 7.0)])
def test_a_passage_is_computed_by_its_method_about_the_point_of_the_moored_ship(monkeypatch, method, given):
    """The middle of its waterline is at (1, 2); only panels know heights"""
    asked = {}
    track = SimpleNamespace(froude=lambda depth: 0.5, through_water=3.0)
    found = SimpleNamespace(
        in_time=SimpleNamespace(times=np.array([0.0, 1.0])), about=lambda center: asked.update(about=center) or found
    )
    hulls = {"moored": ("hull m", np.array([1.0, 2.0, 0.0])), "passing": ("hull p", np.zeros(3))}

    def method_of(name):
        return lambda *all, **more: asked.update({name: (all, more)}) or found

    for name, value in {
        "given": (study := SimpleNamespace(
            method=method, water=SimpleNamespace(depth=15.0, density=1020.0), wall=30.0, quay="quay", peaks="peaks",
            track=SimpleNamespace(lengths=2.0), moored=SimpleNamespace(rotation_center=given), passing=None), "text"),
        "track_of": track, "check_apart": 25.0, "_largest": {}, "_course": {}, "_findings": ["f"], "_notes": ["n"],
    }.items():  # fmt: skip
        monkeypatch.setattr(passing, name, lambda *_, value=value: value)
    monkeypatch.setattr(passing, "_hull", lambda study, name: hulls[name])
    monkeypatch.setattr(
        passing, "size", lambda ship, hull: {"hull m": (200.0, 30.0, 12.0), "hull p": (150.0, 20.0, 9.0)}[hull]
    )
    monkeypatch.setattr(passing, "along_track", lambda *all: asked.update(track=all) or "places")
    monkeypatch.setattr(passing, "Slender", lambda length, section: (length, section))
    monkeypatch.setattr(panels, "largest_section", lambda hull: f"section of {hull}")
    monkeypatch.setattr(panels, "double_body", method_of("panels"))
    monkeypatch.setattr(passing, "wang", method_of("wang"))
    monkeypatch.setattr(passing.by_tests, "depth_factors", lambda *all: asked.update(factors=all) or "factors")
    monkeypatch.setattr(passing.by_tests, "kriebel", method_of("kriebel"))
    made = passing.passing("study")
    assert asked["track"] == (track, 200.0, 150.0, 2.0, 1 if method == "panels" else 6)
    ships = (200.0, "section of hull m"), (150.0, "section of hull p")
    assert asked[method] == {
        "panels": ((("hull m", "hull p"), track, "places", 15.0),
                   {"wall": 30.0, "density": 1020.0, "each": passing._with_progress}),
        "wang": ((*ships, track, "places", 15.0, 1020.0), {}),
        "kriebel": ((*ships, track, "places", "factors"), {"quay": "quay", "peaks": "peaks", "density": 1020.0}),
    }[method]  # fmt: skip
    assert method != "kriebel" or asked["factors"] == (12.0, 15.0, 25.0, 25.0)
    point = np.array(given or (0.0, 0, 0)) - [1, 2, 0]
    assert asked["about"].tolist() == (point * (1, 1, method == "panels")).tolist()
    assert made.labels["time"].values.tolist() == [0, 1] and made.labels["motion"].values.tolist() == [
        "surge",
        "sway",
        "yaw",
    ]
    assert len(made.labels["of_force"].values) == 6 and (made.findings, made.notes, made.detail) == (
        ("f",),
        ("n",),
        found,
    )
    track.froude = lambda depth: 1.0
    with pytest.raises(
        StudyError, match=r"moves at 3 m/s through water of 15 m depth, faster than long waves there, 12\.1 m/s"
    ):
        passing.passing(study)


def test_the_largest_of_a_passage_has_its_place_and_the_part_of_the_flow_speed():
    force = np.array([[1.0, 2, 9, 9, 9, 0], [-4, 1, 9, 9, 9, 0], [2, 8, 9, 9, 9, 0]])
    found = SimpleNamespace(force=force, steady=0.5 * force[::-1], stagger=np.array([-20.0, 0.0, 20.0]))
    made = {name: q.values.tolist() for name, q in passing._largest(found).items()}
    assert made == {"largest.force": [-4, 8, 0], "largest.stagger": [0, 20, -20], "largest.lowest": [-4, 1, 0],
                    "largest.highest": [2, 8, 0], "largest.steady": [0.5, 0.5, 0]}  # fmt: skip
    units = {name: (q.unit, q.description) for name, q in passing._largest(found).items()}
    assert units["largest.force"] == (("N", "N", "N m"), "force") and units["largest.stagger"] == (
        "m",
        "passing ship ahead by",
    )
    assert passing._largest(found)["largest.steady"].share


@pytest.mark.parametrize("plot", [None, Path("p.png")])
def test_a_sweep_is_filled_shown_drawn_and_counted(monkeypatch, tmp_path, capsys, plot):
    from dataclasses import dataclass

    from hakobune.pipelines.sweep import picture

    @dataclass
    class Made:
        findings: tuple = ()

    drawn, asked = [], []
    outcome = SimpleNamespace(cases=9, failed=[(n, 1, f"why {n}") for n in range(7)], lost=(2, "by Ctrl-C"))
    monkeypatch.setattr(sweep, "check_output", lambda *given: asked.append(given))
    monkeypatch.setattr(sweep, "filled", lambda *given: asked.append(given) or (SimpleNamespace(keep="keep"), outcome))
    monkeypatch.setattr(sweep, "result_of", lambda output: f"of {output}")
    monkeypatch.setattr(sweep, "_shown", lambda result, keep: asked.append((result, keep)) or Made())
    monkeypatch.setattr(sweep, "printed", lambda result: asked.append(result) or 1)
    monkeypatch.setattr(picture, "draw", lambda *given: drawn.append(given))
    study = tmp_path / "s.toml"
    place = tmp_path / "s.h5"
    plot = plot and tmp_path / plot
    assert sweep.sweep(study, None, "executor", True, plot) == 1
    assert asked[0] == (place, "the result of a sweep", sweep.is_sweep, sweep.DATABASE, [study])
    assert asked[1] == (study, place, "executor", True, sweep._say) and asked[2] == (f"of {place}", "keep")
    assert drawn == ([(Made(), plot)] if plot else [])
    findings = asked[3].findings
    assert findings[0] == "FAILS: case 0: status 1; why 0" and len(findings) == 7
    assert findings[5] == f"FAILS: 2 more cases have a status above 0; {place} has their messages"
    assert findings[6] == "FAILS: 2 cases were not run, by Ctrl-C; run the same command to continue"
    assert capsys.readouterr().err == f"{place}: 9 cases, of which 7 have a status above 0\n"
    outcome.failed, outcome.lost = outcome.failed[:5], (0, "")
    assert len(list(sweep._findings(outcome, place))) == 5


def test_runs_are_compared_with_other_methods_on_the_waves_of_their_study(monkeypatch, tmp_path):
    from hakobune.pipelines.printing import console
    from hakobune.pipelines.simulate import methods

    said, asked = [], []

    monkeypatch.setattr(console, "new_console", lambda: SimpleNamespace(print=lambda text, **_: said.append(text)))
    monkeypatch.setattr(simulate, "found", lambda *given, **more: asked.append((given, more)) or "result")
    monkeypatch.setattr(methods, "compared", lambda *given: asked.append(given) or "both")
    monkeypatch.setattr(simulate, "processors", lambda: 1)
    monkeypatch.setattr(simulate, "draw_run", lambda path: [f"picture of {path}"])
    monkeypatch.setattr(simulate, "printed", lambda result, console: asked.append(result) or 3)
    more = {"seeds": 2, "duration": 60.0, "fresh": True, "executor": "here", "window": 30.0}
    call = {name: value for name, value in more.items()}
    output = tmp_path / "r.h5"
    import inspect

    names = list(inspect.signature(simulate.simulate).parameters)
    given = {
        "study": "s",
        "database": "d",
        "output": output,
        **call,
        "methods": True,
        "division": "v",
        "pictures": True,
    }
    assert simulate.simulate(**{name: given[name] for name in names}) == 3
    (first, words), second, shown = asked
    assert first == ("s", "d", output) and {name: words[name] for name in more} == more
    assert second == ("result", "s", "d", 60.0, "v") and shown == "both"
    assert said == [f"written: {output}, picture of {output}"]
    with pytest.raises(StudyError, match="--division is given without --methods; give both"):
        simulate.simulate(**{name: (given | {"methods": False})[name] for name in names})
    with pytest.raises(StudyError, match="--seeds is 0; allowed: a whole number from 1"):
        simulate.simulate(**{name: (given | {"seeds": 0})[name] for name in names})


@pytest.mark.parametrize(
    ("mass", "center", "names", "says"),
    [
        (None, None, (), "b.h5: 2 frequencies, no motions: give --gyration kxx,kyy,kzz"),
        (
            1234567.8,
            (0.0, 1.5, -2.0),
            ("rao",),
            "b.h5: 2 frequencies, mass 1.23457e+06 kg, centre of gravity 0, 1.5, -2 m, motions",
        ),
    ],
)
def test_a_weighed_database_is_told_in_one_line(monkeypatch, mass, center, names, says, capsys):
    db = SimpleNamespace(path="b.h5", omega=[1, 2], names=names, attributes={"imported": "wamit"},
                         header=SimpleNamespace(body={"mass": mass, "center_of_mass": center}))  # fmt: skip
    assert weighing._line(db) == says
    monkeypatch.setattr(weighing, "open_database", lambda path: db)
    nothing = SimpleNamespace(given=False)
    assert (
        weighing.weigh(Path("b.h5"), nothing, (0.0, float("inf")), None) == 0 and capsys.readouterr().out == says + "\n"
    )
    db.attributes = {}
    with pytest.raises(
        ValueError, match=r"b\.h5 was solved by hakobune; give --gyration, --center-of-gravity and --mass"
    ):
        weighing.weigh(Path("b.h5"), nothing, (0.0, float("inf")), None)


@pytest.mark.parametrize(("given", "body", "said"), [
    (True, {"inertia_matrix": 1}, ["drift_force depends on the former mass and is removed"]),
    (True, {}, ["drift_force is kept: it belongs to the motions in the files, not to the motions with this mass"]),
    (False, {"inertia_matrix": 1}, []),
])  # fmt: skip
def test_quantities_that_depend_on_the_former_mass_are_left_out_but_for_motions(
    monkeypatch, tmp_path, capsys, given, body, said
):
    """Where no mass was known, motions and drift are those of the files"""
    from dataclasses import dataclass

    @dataclass(frozen=True)
    class Values:
        quantities: dict
        body: dict

    path, out, kept = tmp_path / "b.h5", tmp_path / "new.h5", []
    path.touch()
    db = SimpleNamespace(attributes={"imported": "wamit"}, mesh="mesh")

    @contextmanager
    def beside(output):
        yield f"part of {output.name}"

    values = Values({"rao": 1, "drift_force": 2, "added_mass": 3}, body)
    monkeypatch.setattr(weighing, "open_database", lambda place: db if place == path else f"db {place.name}")
    monkeypatch.setattr(weighing, "NEEDS_MOTION", ("rao", "drift_force", "other"))
    monkeypatch.setattr(weighing, "values_of", lambda db: values)
    monkeypatch.setattr(weighing, "between", lambda values, low, high: kept.append((low, high)) or values)
    monkeypatch.setattr(
        weighing, "on_hull", lambda values, mesh, weight: kept.append(values.quantities) or (values, ["heavy"])
    )
    monkeypatch.setattr(weighing, "read_group", lambda db, name: None if "sum" in name else 1)
    monkeypatch.setattr(weighing, "made_beside", beside)
    monkeypatch.setattr(weighing, "store", lambda *all: kept.append(all))
    monkeypatch.setattr(weighing, "_line", lambda db: f"line of {db}")
    monkeypatch.setattr(weighing, "tell", lambda remarks, console: kept.append(remarks) or 4)
    weight = SimpleNamespace(given=given)
    assert weighing.weigh(path, weight, (0.2, 0.9), out) == 4 and capsys.readouterr().out == "line of db new.h5\n"
    left = {"added_mass": 3} if given and body else values.quantities
    assert kept[:-1] == [(0.2, 0.9), left, (Values(left, body), "mesh", "part of new.h5", "wamit")]
    assert kept[-1][:-1] == ["heavy", *said]
    assert kept[-1][-1].endswith("is not carried over; to keep it, give --mass, --center-of-gravity and --gyration to "
                                 "`hakobune import`")  # fmt: skip
    out.touch()
    with pytest.raises(ValueError, match=r"new\.h5 exists already; give another name by --output"):
        weighing.weigh(path, weight, (0.2, 0.9), out)


@pytest.mark.parametrize(("method", "lids", "omega", "band", "lid"), [
    ("panel", (), 1.0, "band", "lid"), ("pressure", (), 1.0, None, "lid"), ("panel", ("d",), 1.0, None, "lid"),
    ("panel", (), 0.5, "band", None),
])  # fmt: skip
def test_panels_of_a_problem_have_a_lid_for_short_waves_and_a_band_without_damping_lids(
    monkeypatch, method, lids, omega, band, lid
):
    """ω²/g = 0.1 at 1 rad/s and 9.8 m/s²; a lid is needed from 0.05 on"""
    for name, value in {
        "lid_needed_from": 0.05,
        "coarse_hull": "coarse",
        "damping_lids_of": lids,
        "shared_band": "band",
        "finer_hull": "finer",
    }.items():
        monkeypatch.setattr(problem, name, lambda *given, value=value: value)
    monkeypatch.setattr(problem, "make_lid", lambda scene, mesh: "made")
    monkeypatch.setattr(problem, "PanelProblem", lambda *given, **more: (given, more))
    header = SimpleNamespace(mesh="mesh", lid="lid")
    scene = SimpleNamespace(solved_by=method, omegas=lambda: [0.1, omega], water=SimpleNamespace(gravity=9.8), wall=5.0)
    given, more = problem._panel_problem(header, scene, {"depth": 20.0})
    assert given == ("mesh", lid, "coarse", "finer")
    assert more == {"wall": 5.0, "zero_draft": method == "pressure", "damping_lids": lids, "band": band, "depth": 20.0}
    header.lid = None
    assert problem._panel_problem(header, scene, {})[0][1] == (lid and "made")


def test_a_plan_checks_the_weight_of_each_body_and_the_size_of_its_database(monkeypatch):
    asked = []

    @contextmanager
    def named(name):
        asked.append(name)
        yield

    monkeypatch.setattr(plan, "each_body", lambda scene, mesh, body: [("a", 1, 2), ("b", 3, 4)])
    monkeypatch.setattr(plan, "named", named)
    monkeypatch.setattr(plan, "check_weight", lambda *one: asked.append(one))
    monkeypatch.setattr(plan, "check_database", lambda *given: asked.append(given))
    monkeypatch.setattr(plan, "problem_of", lambda header, scene: "problem")
    monkeypatch.setattr(plan, "remarks", lambda scene, hull, body: (body,))
    scene = SimpleNamespace(omegas=lambda: [1, 2, 3], headings=lambda: [0, 1], names=lambda: {"rao"})
    header = SimpleNamespace(body="body")
    made = plan._plan(scene, SimpleNamespace(mesh="mesh"), header)
    assert asked == ["a", (1, 2), "b", (3, 4), (header, 3, 2, {"rao"})]
    assert (made.scene, made.omegas, made.headings, made.names, made.problem, made.remarks) == (
        scene, [1, 2, 3], [0, 1], {"rao"}, "problem", ("body",))  # fmt: skip


@pytest.mark.parametrize(
    ("kinds", "more", "says"),
    [
        ([("vertical", 0), ("vertical", 1)], {}, None),
        ([("file", 0), ("vertical", 1)], {}, None),
        (
            [("file", 0), ("vertical", 0)],
            {},
            "the modes of one body come from a beam and from files; allowed: only one of the two",
        ),
        (
            [("vertical", 0), ("vertical", 0)],
            {},
            "[[modes]] has 'vertical_1' twice; allowed: each kind of beam once per body",
        ),
        ([("vertical", 0)], {"wall": 3.0}, "modes and a wall are given; give only one of them"),
        (
            [("vertical", 0)],
            {"GM": 2.0},
            "modes and the GM of a body are given; give z of center_of_gravity instead of GM",
        ),
        ([], {"wall": 3.0}, None),
    ],
)
def test_shapes_of_a_body_are_of_one_origin_each_once(monkeypatch, kinds, more, says):
    looked = []
    monkeypatch.setattr(modes, "_check", lambda where, mode, scene: looked.append(where))
    monkeypatch.setattr(modes, "owners", lambda scene, mode: [mode.number])
    made = [SimpleNamespace(kind=kind, number=n, body=f"body {n}", count=2, name="own") for kind, n in kinds]
    bodies = [SimpleNamespace(GM=None), SimpleNamespace(GM=more.get("GM"))]
    scene = SimpleNamespace(modes=made, wall=more.get("wall"), bodies=bodies)
    if says:
        with pytest.raises(SceneError) as error:
            modes.check_modes(scene)
        assert str(error.value).startswith(says)
    else:
        modes.check_modes(scene)
        assert looked == [f"modes[{i}]" for i in range(len(kinds))]


def test_hours_of_downtime_have_the_names_of_their_axes(monkeypatch):
    for name, value in {
        "_whole": {"a": 1},
        "_causes": {"b": 2},
        "_by_month": {"c": 3},
        "_by_year": {"d": 4},
        "_by_sector": ({"e": 5}, {"sector": 6}),
        "_windows": ({"f": 7}, {"window": 8}),
    }.items():
        monkeypatch.setattr(answers, name, lambda *given, value=value: value)
    study = SimpleNamespace(operations=[SimpleNamespace(name="cranes"), SimpleNamespace(name="arms")])
    hindcast = SimpleNamespace(year=np.array([2001, 2001, 2002]))
    limits = [SimpleNamespace(label="roll ≤ 2 deg"), SimpleNamespace(label="wind ≤ 20 m/s")]
    verdicts = SimpleNamespace(down=1, known=2, chance=3, error=4)
    made, axes = answers.answers(study, hindcast, limits, verdicts)
    assert made == dict(zip("abcdef", (1, 2, 3, 4, 5, 7), strict=True)) and (axes["sector"], axes["window"]) == (6, 8)
    assert axes["operation"].values.tolist() == ["cranes", "arms"] and axes["year"].values.tolist() == [2001, 2002]
    assert axes["month"].values.tolist()[::11] == ["Jan", "Dec"]
    assert axes["limit"].values.tolist() == ["roll ≤ 2 deg", "wind ≤ 20 m/s"]
