"""Tables, pictures and choices of single points, of numbers that are set by hand: values, units, words."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines.system.parts import UniformLine
from hakobune.mooring.single_point.history import Cycle, Record
from hakobune.mooring.single_point.in_time import Run
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.single_point import checked, loads, quantities, running

LINES = ["a", "b"]


def told(made):
    """{name: (unit, words, table)}"""
    return {name: (one.unit, one.description, one.table) for name, one in made.items()}


def at_rest(heading=-90.0, growth=0.02, pull=2e5, tension=(3e5, 4e5)):
    rad = math.radians(heading)
    return SimpleNamespace(
        heading=rad,
        place=np.array([10.0, -20.0]),
        buoy=np.array([3.0, 4.0]),
        pull=pull,
        force=np.array([1.0, 2.0, 3.0]),
        hawser=np.array([1e5, 1.5e5]),
        roots=np.array([-1 + 1j, -2, -3, -4]),
        quartic=None,
        slewing=SimpleNamespace(growth=growth, stable=growth < 0, period=300.0),
        slews=True,
        lines=SimpleNamespace(
            tension=np.array(tension),
            position=np.array([[3.0, 4.0, -1.5]]),
            lines=SimpleNamespace(grounded_length=np.array([50.0, 60.0])),
        ),
        point=SimpleNamespace(system=SimpleNamespace(breaking_load=np.array([1e6, 2e6]))),
    )


def system(weight=1000.0):
    of = [SimpleNamespace(weight=1.0), SimpleNamespace(weight=weight)]
    lines = [UniformLine.__new__(UniformLine) for _ in of]
    for line, kind, length in zip(lines, of, (100.0, 250.0), strict=True):
        object.__setattr__(line, "type", kind)
        object.__setattr__(line, "length", length)
    return SimpleNamespace(line_names=LINES, depth=40.0, density=1025.0, lines=lines)


def point(**more):
    return SimpleNamespace(
        lengths=[30.0, 30.0],
        system=system(),
        origin=np.array([1.0, 2.0]),
        ends=np.array([[50.0, 4.0], [50.0, -6.0]]),
        **more,
    )


def test_all_headings_of_rest_are_in_one_table():
    rest = [at_rest(), at_rest(10.0, -0.01, 3e5, (9e5, 1e5))]
    made, axes = quantities.rest_of(SimpleNamespace(rest=rest, point=point()))
    title = "headings of rest"
    assert told(made) == {
        "rest.heading": ("rad", "heading", title),
        "rest.stable": ("", "stable", title),
        "rest.growth": ("1/s", "growth", title),
        "rest.period": ("s", "period", title),
        "rest.pull": ("N", "pull", title),
        "rest.largest_line": ("N", "largest line", title),
        "rest.place": ("m", "centre of mass", ""),
        "rest.buoy": ("m", "buoy", ""),
        "rest.buoy_z": ("m", "buoy, z", ""),
        "rest.force": ("N, N, N m", "force of wind, water and drift", ""),
        "rest.hawser": ("N", "pull of", title),
        "rest.line": ("N", "tension", ""),
        "rest.root": ("1/s", "eigenvalue of small motions", ""),
        "rest.quartic": ("", "quartic", ""),
    }
    values = {name: one.values.tolist() for name, one in made.items()}
    assert np.degrees(values["rest.heading"]) == pytest.approx([270, 10])
    assert values["rest.stable"] == [False, True] and values["rest.growth"] == [0.02, -0.01]
    assert values["rest.largest_line"] == [4e5, 9e5] and values["rest.buoy"] == [[3, 4]] * 2
    assert values["rest.buoy_z"] == [-1.5] * 2 and values["rest.place"] == [[10, -20]] * 2
    assert values["rest.line"] == [[3e5, 4e5], [9e5, 1e5]] and np.isnan(values["rest.quartic"]).all()
    assert {name: one.axes for name, one in made.items() if len(one.axes) > 1} == {
        "rest.place": ("rest", "xy"), "rest.buoy": ("rest", "xy"), "rest.force": ("rest", "plane"),
        "rest.hawser": ("rest", "hawser"), "rest.line": ("rest", "line"), "rest.root": ("rest", "root"),
        "rest.quartic": ("rest", "power"),
    }  # fmt: skip
    assert {name: one.values.tolist() for name, one in axes.items()} == {
        "rest": [1, 2], "xy": ["x", "y"], "plane": ["ahead", "to port", "turning"], "line": LINES,
        "hawser": ["hawser 1", "hawser 2"], "root": [1, 2, 3, 4], "power": ["λ⁴", "λ³", "λ²", "λ", "1"],
    }  # fmt: skip
    for one in rest:
        one.hawser, one.quartic = one.hawser[:1], np.arange(5.0)
    made, _ = quantities.rest_of(SimpleNamespace(rest=rest, point=point()))
    assert made["rest.hawser"].table == "" and made["rest.quartic"].values.tolist() == [[0, 1, 2, 3, 4]] * 2


def test_the_final_heading_has_place_pull_and_the_scope_of_its_most_loaded_line():
    """The catenary without uplift: s² = h² + 2 h H/w, of the tension T at the top: H = T − w h"""
    one, title = at_rest(), "at 270°, the heading at which it comes to rest"
    rope, fixed = (
        SimpleNamespace(breaking_load_kN=800.0, breaking_load_tonf=None),
        SimpleNamespace(mass=None, diameter=None),
    )
    hawser = SimpleNamespace(hawser=rope, buoy=fixed)
    made, axes = quantities.state_of(SimpleNamespace(best=one, point=point(), study=hawser))
    scope, height, w, T = "scope without uplift, under steady loads", 38.5, 1000.0, 4e5
    assert axes == {} and told(made) == {
        "heading": ("rad", "heading, from +x to the bow", title),
        "place.x": ("m", "centre of mass, x", title),
        "place.y": ("m", "centre of mass, y", title),
        "buoy.x": ("m", "buoy, x", title),
        "buoy.y": ("m", "buoy, y", title),
        "pull": ("N", "steady pull", title),
        "slewing": ("", "slewing", title),
        "slewing.time": ("s", "grows by a factor of e in", title),
        "slewing.period": ("s", "period", title),
        "hawser.used": ("", "steady pull over the hawser's breaking load", title),
        "slewing.growth": ("1/s", "growth, below 0 for decay", ""),
        "scope.depths": ("", "depths", scope),
        "scope.length": ("m", "length", scope),
        "scope.line": ("m", "length of the line", scope),
    }
    found = {name: one.values.tolist() for name, one in made.items()}
    assert found["hawser.used"] == pytest.approx(max(one.hawser) / 800e3, rel=1e-12)
    length = math.sqrt(height**2 + 2 * height * (T - w * height) / w)
    assert [found[name] for name in ("place.x", "place.y", "buoy.x", "buoy.y", "pull")] == [10, -20, 3, 4, 2e5]
    assert found["scope.length"] == pytest.approx(length, rel=1e-6)
    assert found["scope.depths"] == pytest.approx(length / 40, rel=1e-6) and found["scope.line"] == 250.0
    light = point()
    light.system = system(0.0)
    assert "scope.length" not in quantities.state_of(SimpleNamespace(best=one, point=light, study=hawser))[0]
    light.system.lines[1] = SimpleNamespace(length=9.0, type=SimpleNamespace(weight=5.0))  # of segments
    assert "scope.length" not in quantities.state_of(SimpleNamespace(best=one, point=light, study=hawser))[0]


def test_lines_have_tension_bed_and_the_largest_share_of_their_strength(monkeypatch):
    """Of hawsers and lines the last are the lines"""
    shares = {"rest": np.array([0.9, 0.3, 0.2]), "cycle": np.array([0.1, 0.1, 0.5])}
    monkeypatch.setattr(quantities, "used", lambda study, one, cycle, run: shares if run else {"rest": shares["rest"]})
    found = SimpleNamespace(best=at_rest(), study=SimpleNamespace(allowable=0.6), cycle=1, run=1)
    made, axes = quantities.lines_at(found)
    title = "lines at 270°"
    assert axes == {} and told(made) == {
        "line.tension": ("N", "tension", title), "line.grounded": ("m", "on the bed", title),
        "line.used": ("", "largest utilisation (rest, cycle)", title), "line.breaking_load": ("N", "breaking load", ""),
        "allowable": ("", "allowable", ""),
    }  # fmt: skip
    assert {name: one.values.tolist() for name, one in made.items()} == {
        "line.tension": [3e5, 4e5],
        "line.grounded": [50, 60],
        "line.used": [0.3, 0.5],
        "line.breaking_load": [1e6, 2e6],
        "allowable": 0.6,
    }
    assert made["line.used"].share and made["allowable"].share and not made["line.tension"].share
    found.run = None
    one = quantities.lines_at(found)[0]["line.used"]
    assert one.description == "used" and one.values.tolist() == [0.3, 0.2]


def test_a_limit_cycle_has_the_pull_of_all_hawsers_together():
    """Hawsers of 3 and 4 pull with 5"""
    assert quantities.cycle_of(SimpleNamespace(cycle=None)) == ({}, {})
    cycle = SimpleNamespace(amplitude=0.3, middle=-math.pi / 2, period=400.0, time=np.array([0.0, 200.0]),
                            hawser=np.array([[3e4, 4e4], [6e4, 8e4]]), lines=np.array([[1e5, 2e5], [7e5, 3e5]]),
                            states=np.arange(12.0).reshape(2, 6))  # fmt: skip
    made, axes = quantities.cycle_of(SimpleNamespace(cycle=cycle))
    title = "limit cycle"
    assert told(made) == {
        "cycle.amplitude": ("rad", "heading amplitude", title), "cycle.middle": ("rad", "of", title),
        "cycle.period": ("s", "period", title), "cycle.least_pull": ("N", "least pull", title),
        "cycle.largest_pull": ("N", "largest pull", title), "cycle.largest_line": ("N", "largest line", title),
        "cycle.state": ("m, m, rad, m/s, m/s, rad/s", "state of the body", ""), "cycle.hawser": ("N", "pull", ""),
        "cycle.lines": ("N", "tension", ""),
    }  # fmt: skip
    values = {name: one.values.tolist() for name, one in made.items()}
    assert values["cycle.middle"] == pytest.approx(1.5 * math.pi)
    assert [values[f"cycle.{name}"] for name in ("amplitude", "period", "largest_line")] == [0.3, 400, 7e5]
    assert (values["cycle.least_pull"], values["cycle.largest_pull"]) == pytest.approx((5e4, 1e5))
    assert [made[f"cycle.{name}"].axes[1] for name in ("state", "hawser", "lines")] == ["state", "hawser", "line"]
    assert axes["state"].values.tolist() == ["x", "y", "heading", "ahead", "to port", "turning"]
    assert axes["in_cycle"].values.tolist() == [0, 200]


TIME = np.array([0.0, 100.0, 200.0])


def ran(drifts=False, wave=0.0, stable=True, hawsers=1):
    place, buoy = np.array([[0.0, 1], [2, 3], [4, 5]]), np.array([[0.5, 0.0], [0.6, 0.1], [0.7, 0.2]])
    motion = wave * np.array([[0.0] * 6, [1.0, 2, 3, 0.1, 0.2, 0.3], [0.0] * 6])
    record = Record(TIME, place, np.radians([2.0, 4.0, 6.0]), motion, buoy, np.array([[1e5], [3e5], [2e5]]),
                    np.array([[1e5, 2e5], [4e5, 3e5], [2e5, 6e5]]), np.array([10.0, 12.0, 11.0]))  # fmt: skip
    at = point()
    at.lengths = np.full(hawsers, 30.0)
    steady = SimpleNamespace(
        heading=math.radians(1.0),
        point=at,
        hawser=np.array([1e5]),
        slewing=SimpleNamespace(stable=stable),
        slews=True,
        lines=SimpleNamespace(tension=np.array([1e5, 2e5])),
    )
    return Run(record, steady, Cycle(0.1, 250.0, 1.0, False), 150.0, 12.5, drifts, ("one",), 0.0)


@pytest.mark.parametrize("wave", [0.0, 1.0])
def test_a_run_is_kept_with_its_records(wave):
    run = ran(wave=wave)
    made, axes = quantities.run_of(SimpleNamespace(run=run, point=run.steady.point))
    title, record = "200 s in time, motion", "record"
    of = told(made)
    assert {name: of[name] for name in of if not name.startswith("run.s") and name[4:] not in ("mean", "largest")} == {
        "run.amplitude": ("rad", "heading amplitude at the end", title),
        "run.period": ("s", "period at the end", title),
        "run.excursion": ("m", "buoy, largest distance from its place without the hull", title),
        "run.radius": ("m", "watch circle about the buoy at rest, radius", title),
        "run.wave_sigma": (
            ("m", "m", "m", "rad", "rad", "rad"),
            "standard deviation",
            "motion in the waves" if wave else "",
        ),
        "run.place": ("m", "centre of mass in slow motion", ""),
        "run.heading_in_time": ("rad", "heading in slow motion", ""),
        "run.wave_motion": ("m, m, m, rad, rad, rad", "motion in the waves", ""),
        "run.buoy": ("m", "buoy", ""),
        "run.hawser_tension": ("N", "tension", ""),
        "run.line_tension": ("N", "tension", ""),
        "run.wind_speed": ("m/s", "wind", ""),
    }
    assert of["run.settled"] == ("s", "time to come within 0.2° of rest", title)
    assert of["run.largest"][0::2] == ("N", "200 s in time") and of["run.largest"][1] == "largest"
    assert made["run.place"].record and made["run.place"].axes == ("time", "xy") and record
    r = run.record
    kept = {"place": r.place, "heading_in_time": r.heading, "wave_motion": r.wave, "buoy": r.buoy,
            "hawser_tension": r.hawser, "line_tension": r.lines, "wind_speed": r.wind_speed}  # fmt: skip
    assert all(np.array_equal(made[f"run.{name}"].values, value) for name, value in kept.items())
    assert [made[f"run.{name}"].values.item() for name in ("amplitude", "period", "settled", "radius")] == [
        0.1,
        250,
        150,
        12.5,
    ]
    assert axes["motion"].values.tolist() == ["surge", "sway", "heave", "roll", "pitch", "yaw"]
    assert axes["rope"].values.tolist() == ["hawser 1", *LINES] and axes["time"].values.tolist() == TIME.tolist()
    assert quantities.run_of(SimpleNamespace(run=None)) == ({}, {})
    words = [quantities._of_rope("significant_with_drift", "t", drifts) for drifts in (True, False)]
    assert words == [("significant + 20 %", ""), ("significant + 20 %", "t")] and quantities._of_rope(
        "mean", "t", True
    ) == ("mean", "t")


def test_maps_are_kept_over_their_keys_and_the_share_that_slews():
    """Growth of 0 does not slew; the place without an answer counts for nothing"""
    two = SimpleNamespace(keys=("hawser.length", "wind.speed"), x=np.array([1.0, 2.0]), y=np.array([5.0, 6.0]),
                          growth=np.array([[0.0, 1.0], [-1.0, np.nan]]), period=np.full((2, 2), 9.0),
                          heading=np.full((2, 2), 180.0))  # fmt: skip
    made, axes = quantities.maps_of(SimpleNamespace(maps=[two, two]))
    over = "over hawser.length and wind.speed"
    assert made["map_2.slews"].values == pytest.approx(1 / 3) and made["map_2.slews"].share
    assert told(made)["map_1.slews"] == ("", f"map {over}: slewing", "maps")
    assert told(made)["map_1.growth"] == ("1/s", f"growth {over}", "") and made["map_1.growth"].axes == (
        "map_1_y",
        "map_1_x",
    )
    assert told(made)["map_1.heading"][0] == "rad" and made["map_1.heading"].values[1, 1] == pytest.approx(math.pi)
    assert told(made)["map_1.period"][0] == "s" and made["map_1.period"].values.tolist() == [[9, 9]] * 2
    assert axes["map_1_x"].values.tolist() == [1, 2] and axes["map_2_y"].values.tolist() == [5, 6]
    assert (axes["map_1_x"].description, axes["map_1_y"].description) == two.keys


@pytest.mark.parametrize(("freeboard", "above"), [(None, 6.0), (3.0, 3.0)])
def test_a_film_has_the_hull_about_the_middle_of_its_hawsers(freeboard, above):
    """Ends at (50, 4) and (50, −6) from the centre of mass, attached at (60, 1) of midship: midship is at (−10, −2)"""
    study = SimpleNamespace(
        hull=SimpleNamespace(length=120.0, beam=20.0, draft=12.0, freeboard=freeboard),
        attachment=SimpleNamespace(x=60.0, y=1.0), water=SimpleNamespace(depth=40.0),
    )  # fmt: skip
    made, axes = quantities.hull_of(SimpleNamespace(study=study, point=point()))
    assert {name: one.values.tolist() for name, one in made.items()} == {
        "hull.size": [120, 20, 12, above], "hull.middle": [-10, -2], "hawser.end": [[50, 4], [50, -6]],
        "water.depth": 40, "water.density": 1025,
    }  # fmt: skip
    assert [one.unit for one in made.values()] == ["m", "m", "m", "m", "kg/m3"]
    assert [one.description for one in made.values()] == [
        "size of the hull",
        "middle of the hull",
        "end on the hull",
        "depth of the water",
        "density of the water",
    ]
    assert axes["size"].values.tolist() == ["length", "beam", "draft", "freeboard"]


def test_criteria_of_slewing_are_told_with_the_lengths_where_it_begins(monkeypatch):
    yaw = SimpleNamespace(straight_line=2.0, lever=7.0, static=False, lengths=[12.3456, 50.0])
    asked = []
    monkeypatch.setattr(quantities, "yaw_stability", lambda *given: asked.append(given) or yaw)
    monkeypatch.setattr(quantities, "routh_hurwitz", lambda q: q == "q")
    monkeypatch.setattr(quantities, "undamped", lambda q: f"{q} undamped")
    monkeypatch.setattr(quantities, "undamped_stable", lambda q: q != "q undamped")
    one = at_rest()
    one.quartic, one.state = "q", np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    one.lateral = SimpleNamespace(length=100.0, arm=60.0)
    made, title = quantities._criteria(one), "criteria of slewing"
    assert told(made) == {
        "criterion.line": ("m", "effective line", title), "criterion.routh_hurwitz": ("", "Routh–Hurwitz", title),
        "criterion.undamped": ("", "undamped", title),
        "criterion.arm": ("m", "attachment ahead of the centre of mass", title),
        "criterion.lever": ("m", "centre of the side force at a small heading, ahead of the centre of mass", title),
        "criterion.static": ("", "in yaw, statically", title),
        "criterion.straight": ("", "keeps a straight course when towed", title),
        "criterion.straight_line": ("N2 s2", "Y_v N_r − N_v (Y_r − MU)", ""),
    }  # fmt: skip
    assert [q.values.item() for q in made.values()] == [100, "stable", "slews", 60, 7, "unstable", True, 2]
    lateral, speed, lengths = asked[0]
    assert lateral is one.lateral and speed == 4.0 and len(lengths) == 200
    assert lengths[[0, -1]] == pytest.approx([2.0, 2000.0]) and np.ptp(np.diff(np.log(lengths))) < 1e-9
    yaw.straight_line, yaw.static = -1.0, True
    assert quantities._criteria(one)["criterion.straight"].values.item() is False
    assert quantities._criteria(one)["criterion.static"].values == "stable"
    said = "slewing begins or ends at effective line lengths of {} (range 2 to 2e+03 m)"
    of = {"best": one, "study": SimpleNamespace(buoy=SimpleNamespace(mass=None)), "point": point()}
    assert list(quantities.notes_of(SimpleNamespace(**of, run=None))) == [said.format("12.35 m, 50 m")]
    yaw.lengths = []
    monkeypatch.setattr(running, "words", lambda run: [f"of {run}"])
    assert list(quantities.notes_of(SimpleNamespace(**of, run="it"))) == [said.format("none"), "of it"]
    assert quantities._criteria(at_rest()) == {}


def test_the_heading_decays_from_where_it_began_relative_to_rest():
    """2° of 1° at rest"""
    assert next(iter(running.words(ran()))) == "the heading decays from 1° to within 0.2° of rest in 150 s"


@pytest.mark.parametrize("length", [0.0, 30.0])
def test_a_run_is_drawn_with_rest_tensions_and_its_track(monkeypatch, tmp_path, length):
    from hakobune.pipelines.single_point import pictures

    made, hulls = [], []
    monkeypatch.setattr(pictures, "save", lambda figure, path, dpi: made.append((figure, path)))
    monkeypatch.setattr(pictures, "draw_lines", lambda axes, lines: hulls.append(lines))
    monkeypatch.setattr(
        pictures, "draw_hull", lambda axes, study, point, place, heading, **_: hulls.append((*place, heading))
    )
    run = ran(wave=1.0)
    run.steady.point.lengths[0] = length
    pictures.draw_run(SimpleNamespace(hull=SimpleNamespace(length=10.0)), run, tmp_path / "r.png")
    ((figure, path),) = made
    assert path == tmp_path / "r.png"
    heading, hawser, lines, plan, buoy = figure.axes
    assert heading.lines[0].get_xydata() == pytest.approx(
        np.column_stack([TIME, np.degrees(np.radians([2, 4, 6]) + [0, 0.3, 0])]))  # fmt: skip
    assert heading.lines[1].get_ydata() == pytest.approx([1, 1]) and heading.lines[1].get_label() == "of rest"
    assert hawser.lines[0].get_xydata() == pytest.approx(np.column_stack([TIME, [100, 300, 200]]))
    assert lines.lines[0].get_xydata() == pytest.approx(np.column_stack([TIME, [200, 300, 600]]))  # b, the most loaded
    assert (heading.get_ylabel(), lines.get_ylabel(), lines.get_xlabel()) == ("heading, °", "b, kN", "time, s")
    assert hawser.get_ylabel() == ("hawser, kN" if length else "pull on buoy, kN")
    assert hulls[0] is run.steady.lines and len(hulls) == 3  # begin, which is the least heading, and the largest
    assert hulls[1][:2] == (0, 1) and hulls[-1] == (4, 5, pytest.approx(math.radians(6)))
    assert (
        plan.lines[-1].get_xydata() == pytest.approx(run.record.place) and plan.get_aspect() == buoy.get_aspect() == 1.0
    )
    track, circle, place = buoy.lines
    assert track.get_xydata() == pytest.approx(run.record.buoy)
    reach = max(np.hypot(*(run.record.buoy - [1.0, 2.0]).T))
    assert np.hypot(*(circle.get_xydata() - [1.0, 2.0]).T) == pytest.approx(np.full(181, reach))
    assert place.get_xydata().tolist() == [[1.0, 2.0]] and f"{reach:.3g} m at most" in buoy.get_title()


def test_a_constant_record_is_drawn_as_a_level_line(monkeypatch, tmp_path):
    from hakobune.pipelines.single_point import pictures

    made = []
    monkeypatch.setattr(pictures, "save", lambda figure, path, dpi: made.append(figure))
    for name in ("draw_lines", "draw_hull"):
        monkeypatch.setattr(pictures, name, lambda *given, **_: None)
    run = ran()
    run.record.hawser[:] = 2e5 + np.array([[0.0], [1e-3], [0.0]])
    pictures.draw_run(SimpleNamespace(hull=SimpleNamespace(length=10.0)), run, tmp_path / "r.png")
    low, high = made[0].axes[1].get_ylim()
    assert (low, high) == pytest.approx((200 - 0.02, 200 + 0.02), abs=1e-4)
    low, high = made[0].axes[2].get_ylim()
    assert low < 200 and high > 600


def of_study(scheme="full", waves=True, hawser=True, **more):
    buoy = {"mass": 50.0, "draft": None, "diameter": 8.0, "height": 5.0, "z": 1.0, "hawser_z": 3.0}
    rope = {
        "axial_stiffness_kN": 2e4,
        "axial_stiffness_tonf": None,
        "breaking_load_kN": None,
        "breaking_load_tonf": None,
        "strain": None,
        "exponent": 1.5,
    }
    buoy |= {key: more[key] for key in buoy if key in more}
    rope |= {key: more[key] for key in rope if key in more}
    return SimpleNamespace(
        slewing=SimpleNamespace(scheme=scheme),
        waves=SimpleNamespace(drift_tonf_per_m2=more.get("drift")) if waves else None,
        hawser=SimpleNamespace(**rope) if hawser else None,
        buoy=SimpleNamespace(**buoy),
        attachment=SimpleNamespace(z=6.0),
        current=None,
    )


@pytest.mark.parametrize(
    ("more", "says"),
    [
        ({}, None),
        ({"mass": None}, 'slewing.scheme is "full"; with a hawser it needs mass, diameter and height of [buoy]'),
        ({"hawser_z": 0.9}, "buoy.hawser_z is 0.9 m; allowed: at least buoy.z, 1 m, at most buoy.height, 5 m"),
        ({"hawser_z": 5.1}, "buoy.hawser_z is 5.1 m"),
        ({"hawser_z": 1.0}, None),
        ({"hawser_z": 5.0}, None),
        ({"hawser_z": None}, None),
        (
            {"axial_stiffness_kN": None},
            'hawser: slewing.scheme "full" needs axial_stiffness, or breaking_load with its strain',
        ),
        ({"breaking_load_kN": 9.0, "strain": 0.1}, "hawser: slewing.scheme"),
        ({"strain": 0.1}, "hawser: slewing.scheme"),
        ({"axial_stiffness_kN": None, "breaking_load_kN": 9.0}, "hawser: slewing.scheme"),
        ({"axial_stiffness_kN": None, "breaking_load_kN": 9.0, "strain": 0.1}, None),
        ({"axial_stiffness_kN": None, "breaking_load_kN": 9.0, "strain": -0.1}, "hawser.strain is -0.1"),
        ({"axial_stiffness_kN": None, "breaking_load_kN": 9.0, "strain": 0.1, "exponent": 0.0}, "hawser.exponent is 0"),
    ],
)
def test_a_buoy_of_its_own_mass_needs_an_elastic_hawser_at_its_height(more, says):
    """50 t; 3 m above the keel and 2 m above the place of the lines; kN"""
    if says:
        with pytest.raises(StudyError) as error:
            running._buoy_and_rope(of_study(**more))
        assert str(error.value).startswith(says)
        return
    body, rope = running._buoy_and_rope(of_study(**more), SimpleNamespace(system=None))
    lever = {"hawser_z": more.get("hawser_z", 3.0)}["hawser_z"]
    assert (body.mass, body.diameter, body.height) == (5e4, 8.0, 5.0)
    assert body.lever == (0.0 if lever is None else lever - 1.0)
    assert tuple(rope)[:2] == (2e7, 1.0) if not more.get("strain") else tuple(rope) == (9e3, 0.1, 1.5)


@pytest.mark.parametrize(
    ("scheme", "waves", "db", "runs"),
    [
        ("slow", True, True, "slow"),
        ("two_scale", True, True, "two"),
        ("full", True, True, "full"),
        (None, True, True, "two"),
        ("full", False, True, "full"),
        ("full", True, None, "full"),
        (None, True, None, "slow"),
        (None, False, True, "slow"),
    ],
)
def test_a_run_has_waves_where_a_database_knows_them_and_the_scheme_is_not_slow(monkeypatch, scheme, waves, db, runs):
    monkeypatch.setattr(running, "check", lambda study, db: None)
    monkeypatch.setattr(running, "_in_one", lambda study, times, steady, db, waves: ("full", bool(waves)))
    monkeypatch.setattr(running, "_wave_body", lambda study, db: "body")
    monkeypatch.setattr(running, "two_scale_run", lambda steady, times, body: ("two", steady, body))
    monkeypatch.setattr(running, "slow_run", lambda steady, times: ("slow", steady, times))
    study = of_study(scheme, waves)
    more = {
        "duration": 3600.0,
        "step": 0.5,
        "slow_step": 10.0,
        "waves_after": 600.0,
        "offset_deg": 90.0,
        "tolerance": 1e-3,
        "seed": 7,
    }
    study.slewing = SimpleNamespace(scheme=scheme, **more)
    made = running.run(study, "steady", db)
    assert made[0] == runs
    if runs == "slow":
        assert tuple(vars(made[2]).values()) == (3600.0, 0.5, 10.0, 600.0, pytest.approx(math.pi / 2), 1e-3, 7)
    if runs == "full":
        assert made[1] is bool(waves and db)


@pytest.mark.parametrize(("scheme", "waves", "db", "refused"), [
    ("two_scale", True, True, False), ("two_scale", False, True, True), ("two_scale", True, None, True),
    ("slow", True, None, False), ("full", True, None, False)])  # fmt: skip
def test_two_scales_need_waves_of_a_database(monkeypatch, scheme, waves, db, refused):
    looked = []
    monkeypatch.setattr(running, "_check", looked.append)
    monkeypatch.setattr(running, "_buoy_and_rope", looked.append)
    study = of_study(scheme, waves)
    if refused:
        with pytest.raises(
            StudyError, match=r"is \"two_scale\", which needs \[waves\] and --database; give both, or \"slow\""
        ):
            running.check(study, db)
    else:
        running.check(study, db)
        assert looked == [study.slewing, *[study] * (scheme == "full")]
        study.hawser = None
        running.check(study, db)
        assert looked[-1] is study.slewing


@pytest.mark.parametrize(("waves", "drift", "length"), [(True, None, 30.0), (True, 2.0, 30.0), (False, None, 0.0)])
def test_one_equation_has_first_order_waves_and_their_drift_where_the_database_has_it(
    monkeypatch, waves, drift, length
):
    run, asked = ran(), []
    steady = SimpleNamespace(point=SimpleNamespace(lengths=np.array([length])))
    times = SimpleNamespace(begin=lambda steady: "begin")
    monkeypatch.setattr(running, "_buoy_and_rope", lambda study, point: ("buoy", "rope"))
    monkeypatch.setattr(running, "_sea", lambda study, db: "sea")
    monkeypatch.setattr(running, "_components", lambda study, db: "parts" if db == "db" else None)
    monkeypatch.setattr(running, "waves_carrier", lambda study: "carrier")
    monkeypatch.setattr(running, "body_at", lambda *given, **more: asked.append((given, more)) or "moved")
    monkeypatch.setattr(running, "full_run", lambda *given: asked.append(given) or run)
    found = running._in_one(of_study(drift=drift), times, steady, "db", waves)
    (given, more), last = asked
    assert given == (steady, "begin", "db")
    ropes = ("buoy", "rope") if length else (None, None)
    assert more == {"buoy": ropes[0], "rope": ropes[1], "end_z": 6.0, "sea": "sea" if waves else None}
    assert last == (steady, times, "moved", "parts" if waves else None, waves and drift is None, "carrier")
    left = "waves act by their mean drift only; give --database for first-order motions"
    assert found.findings == (("one",) if waves else (left, "one"))


def test_a_study_is_checked_with_its_database_as_far_as_it_is_known(monkeypatch):
    """Waves that come with a database are looked at for its directions, and not computed; its mass is known then"""
    import msgspec

    from hakobune.pipelines.single_point.tables import HullTable, WavesTable

    class Known(msgspec.Struct):
        hull: HullTable
        water: object
        mass: object = None
        waves: object = None
        slewing: object = None

    said = []
    monkeypatch.setattr(checked, "check_database", lambda *given: said.append("database"))
    monkeypatch.setattr(checked, "check_headings", lambda body, seas: said.append(("headings", body, seas)))
    monkeypatch.setattr(checked, "sea_with_swell", lambda *given: given)
    monkeypatch.setattr(checked, "make", lambda known, is_round: said.append(known))
    monkeypatch.setattr(checked, "check", lambda *given: said.append(("slewing", *given)))
    hull, waves = HullTable(length=100.0, beam=20.0, draft=8.0), WavesTable(height=2.0, period=8.0)
    study = Known(hull, SimpleNamespace(depth=30.0), None, waves)
    body = SimpleNamespace(rotation_center=(3.0, 0.0, 0.0), ring=None)
    checked.checked(study, body)
    assert said[:2] == ["database", ("headings", body, [("waves", waves, 30.0)])] and len(said) == 3
    assert said[2].waves is None and said[2].hull.center == 3.0 and said[2].mass is not None and study.mass is None
    said.clear()
    study.slewing, study.mass, study.waves = "slewing", "mass", WavesTable(height=2.0, drift_tonf_per_m2=1.0)
    checked.checked(study, body)
    assert said == ["database", study, ("slewing", study, body)] and said[1].hull.center == hull.center
    said.clear()
    study.mass = None
    checked.checked(study)
    assert said == [study, ("slewing", study, None)]


def test_drift_of_a_database_tells_of_waves_that_the_current_stops(monkeypatch):
    for name, value in {
        "sea_with_swell": SimpleNamespace(spectrum="spectrum"),
        "too_high": ["too high"],
        "wave_forces": "forces",
        "waves_carrier": None,
        "_between_waves": ["unsure"],
        "check_blocked": ["blocked"],
        "_outside": ["outside"],
        "mean_drift": "mean",
        "DriftLoad": "load",
    }.items():
        monkeypatch.setattr(loads, name, lambda *given, value=value: value)
    body = SimpleNamespace(depth=30.0, gravity=9.8)
    monkeypatch.setattr(loads, "in_sea", lambda reader, sea: (body, None))
    db = SimpleNamespace(reader=SimpleNamespace(knows_drift=True), water_depth=30.0)
    findings, study = [], SimpleNamespace(waves=SimpleNamespace(drift_tonf_per_m2=None), current=None)
    assert loads._drift(study, db, np.zeros(2), findings) == "load" and findings == [
        "outside",
        "too high",
        "unsure",
        "blocked",
    ]
    monkeypatch.setattr(loads, "waves_carrier", lambda study: "carrier")
    monkeypatch.setattr(loads, "_by_current", lambda drift, still, current: f"{drift} {still}")
    findings.clear()
    loads._drift(study, db, np.zeros(2), findings)
    assert findings == ["outside", "too high", "unsure", "blocked", "mean mean"]
    assert loads._drift(SimpleNamespace(waves=None), db, 0, []) is None
    db.reader.knows_drift = False
    for given, says in (
        (db, "the database contains no drift"),
        (None, "waves: the wave drift is unknown; give --database"),
    ):
        with pytest.raises(StudyError, match=says):
            loads._drift(study, given, np.zeros(2), [])
