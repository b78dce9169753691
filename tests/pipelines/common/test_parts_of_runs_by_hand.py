"""Parts of commands that only long runs go through: tables of runs, methods side by side, pairs, fading motions."""

import math
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.exchange.weighing import _line
from hakobune.pipelines.line_dynamics import parts
from hakobune.pipelines.line_dynamics.motion import faded
from hakobune.pipelines.qtf import problem as of_pairs
from hakobune.pipelines.qtf import question, running
from hakobune.pipelines.response import places
from hakobune.pipelines.simulate import berth, methods, result

# ------------------------------------------------------------------ tables of runs


def test_the_first_record_is_told_in_windows_of_its_length(monkeypatch):
    asked = []
    found = SimpleNamespace(
        amplitude=np.arange(6.0).reshape(2, 3), period=10 + np.arange(6.0).reshape(2, 3), start=[0, 60]
    )
    monkeypatch.setattr(result, "windows", lambda *given: asked.append(given) or found)
    file = {"time": np.array([0.0, 0.25, 0.5]), "motion": np.ones((2, 3, 6), np.float32), "kept_seed": [7, 8]}
    start, made = result._windows(file, 60.0)
    assert asked[0][1:] == (0.25, 60.0) and asked[0][0].shape == (3, 6) and start == [0, 60]
    units = {name: (one.values.tolist(), one.unit) for name, one in made.items()}
    assert units == {
        "window.surge": ([0, 3], "m"), "window.surge_period": ([10, 13], "s"), "window.sway": ([1, 4], "m"),
        "window.sway_period": ([11, 14], "s"), "window.yaw": ([2, 5], "rad"), "window.yaw_period": ([12, 15], "s"),
    }  # fmt: skip


def rows(names, start=0.0):
    keys = ("mean", "sigma", "smallest", "largest", "upper_median")
    return {name: {key: start + 10 * k + j for j, key in enumerate(keys)} for k, name in enumerate(names)}


def test_gaps_and_hinges_of_runs_are_those_of_their_rows():
    values = rows(["gap a", "surge", "gap b", "h x", "h m"])
    made = result._of_gaps(["gap a", "surge", "gap b"], values)
    assert {name: one.values.tolist() for name, one in made.items()} == {
        "gap.mean": [0, 20], "gap.smallest": [2, 22], "gap.largest": [3, 23],
    }  # fmt: skip
    assert result._of_gaps(["surge"], values) == {}
    made = result._at_places("hinge", "", ["h x", "h m"], {"h x": "N", "h m": "N m"}, values)
    assert made["hinge.sigma"].values.tolist() == [31, 41] and made["hinge.sigma"].unit == ("N", "N m")
    assert set(made) == {"hinge.mean", "hinge.sigma", "hinge.smallest", "hinge.largest"}
    assert result._at_places("hinge", "", [], {}, values) == {}


def test_fenders_of_runs_are_told_with_what_they_use_of_their_rating(monkeypatch):
    values = rows(["deflection f", "deflection g", "reaction f", "reaction g"], 1.0)
    monkeypatch.setattr(result, "fender_strains", lambda file: (np.array([0.2, 0.3]), np.array([0.5, 0.6])))
    file = SimpleNamespace(attrs={"fender_rated_reaction": [48.0, 68.0]})
    made = result._of_fenders(file, ["f", "g"], values)
    assert made["deflection.largest"].values.tolist() == [4, 14] and made["deflection.mean"].unit == "m"
    assert made["reaction.extreme_median"].values.tolist() == [25, 35] and made["reaction.rated"].values[1] == 68.0
    assert made["reaction.used"].values.tolist() == [0.5, 0.5]
    assert made["strain.largest"].values.tolist() == [0.2, 0.3] and made["strain.allowable"].values[0] == 0.5
    monkeypatch.setattr(result, "fender_strains", lambda file: None)
    file.attrs = {}
    assert not {name for name in result._of_fenders(file, ["f", "g"], values) if "used" in name or "strain" in name}
    assert result._of_fenders(file, [], values) == {}


# ------------------------------------------------------------------ methods beside each other


@dataclass
class Settings:
    memory: str = "states"
    step: float = 0.5
    constant_period: float | None = None


@pytest.mark.parametrize(
    "states, changed, fitted",
    [(5, {}, False), (0, {}, True), (0, {"memory": "constant", "constant_period": 9.0}, False)],
)
def test_a_method_is_run_with_the_memory_it_needs_and_told_after_its_ramp(states, changed, fitted, monkeypatch):
    body, asked = SimpleNamespace(memory=SimpleNamespace(states=states)), []
    time = np.arange(-2.0, 4.0, 0.5)
    motion = np.arange(len(time) * 6.0).reshape(-1, 6)
    monkeypatch.setattr("hakobune.mooring.motion.simulation.with_memory", lambda given: "fitted")
    monkeypatch.setattr("hakobune.mooring.motion.simulation.simulate", lambda *given: asked.append(given) or (
        SimpleNamespace(motion=motion, time=time)))  # fmt: skip
    monkeypatch.setattr(
        methods,
        "windows",
        lambda late, step, length: (
            asked.append((late, step, length))
            or (
                SimpleNamespace(
                    amplitude=np.array([[methods.STILL[0], 2.0, 3.0]]),
                    period=np.array([[4.0, 5.0, 6.0]]),
                )
            )
        ),
    )
    plan = SimpleNamespace(settings=Settings(), weather="weather")
    row = methods._row(body, plan, changed, 7)
    given, weather, settings, seed = asked[0]
    assert (given == "fitted") == fitted and (weather, seed) == ("weather", 7)
    assert settings.memory == changed.get("memory", "states")
    late, step, length = asked[1]
    assert np.array_equal(late, motion[4:]) and (step, length) == (0.5, 0.5 * 7)
    assert row.tolist() == [[0.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    assert methods._constant(np.float64(9.0)) == {"memory": "constant", "constant_period": 9.0}


@dataclass
class Water:
    rotation_center: tuple = (0.0, 0.0, -1.0)
    depth: float = 20.0
    inertia: object = "own inertia"
    stiffness: object = "own stiffness"
    viscous: object = "viscous"
    own: bool = True


@pytest.mark.parametrize("change, says", [
    ({}, None), ({"depth": 21.0}, "whose depth or rotation centre differs"),
    ({"rotation_center": (0.0, 0.0, -1.1)}, "whose depth or rotation centre differs"),
    ("panel", "solved by the panel method"),
])  # fmt: skip
def test_water_of_another_database_moves_the_body_of_this_one(change, says, monkeypatch):
    from hakobune.mooring.motion import simulation

    method = change if isinstance(change, str) else "contour"
    water = Water(**({} if isinstance(change, str) else change))
    db = SimpleNamespace(attributes={"method": method}, sizes="sizes", reader=water)
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: db)
    made = {}
    monkeypatch.setattr(
        simulation, "moored", lambda reader, *given, **more: made.update(more, reader=reader, given=given)
    )
    here = Water(inertia="inertia", stiffness="stiffness")
    body = SimpleNamespace(
        reader=here,
        **{
            name: name
            for name in (
                "system",
                "hull",
                "spring",
                "damping",
                "quadratic",
                "berth",
                "free",
                "start",
                "memory",
                "motions",
            )
        },
    )
    study = SimpleNamespace(hull_of=lambda sizes: made.update(sizes=sizes))
    if says:
        with pytest.raises(StudyError, match=says):
            methods._divided(study, body, "other.h5")
    else:
        methods._divided(study, body, "other.h5")
        one = made["reader"]
        assert (one.inertia, one.stiffness, one.viscous, one.own) == ("inertia", "stiffness", None, False)
        assert made["sizes"] == "sizes" and made["given"][:2] == ("system", "hull")
        assert (made["spring"], made["damping"], made["quadratic"], made["berth"]) == (
            "spring", "damping", "quadratic", "berth",
        )  # fmt: skip


def study_at_quay(**more):
    sea = SimpleNamespace()
    given = {"rope": [], "lines": [], "spreads": [], "waves": SimpleNamespace(swell=[], file=None),
             "simulation": SimpleNamespace(record=None), "water": SimpleNamespace(depth=20.0),
             "conditions": lambda: SimpleNamespace(sea=sea)}  # fmt: skip
    return SimpleNamespace(**given | more)


def test_fenders_alone_are_judged_by_the_design_spectrum_too(monkeypatch):
    from hakobune.mooring.dolphins.design_spectrum import DolphinError

    strains = SimpleNamespace(static=0.1234, static_strain=0.0617, sigma=0.05, largest=0.3, strain=0.15)
    found = SimpleNamespace(count=3, strains=strains, limit=2.346)
    asked = []
    monkeypatch.setattr("hakobune.mooring.dolphins.at_quay.at_quay", lambda *given: asked.append(given) or found)
    monkeypatch.setattr(
        "hakobune.mooring.studies.steady_loads.with_coefficients", lambda conditions, hull, depth: depth
    )
    monkeypatch.setattr("hakobune.mooring.studies.steady_loads.steady_loads",
                        lambda db, hull, steady, depth: {"wind": [1, 20.0, 3], "current": [1, 300.0, 3]})  # fmt: skip
    monkeypatch.setattr("hakobune.pipelines.common.weather.seas.family_of", lambda *given: max)
    monkeypatch.setattr("hakobune.pipelines.common.weather.seas.shape_of", lambda waves: {})
    said = berth.by_design_spectrum(study_at_quay(), None, "body", "hull", "fenders")
    assert said == (
        "design spectrum method, 3 fenders: static 0.123 m (6.17 %), σ 0.05 m, largest 0.3 m (15 %); "
        "allowed: 10 and 35 %, up to a significant height of 2.35 m"
    )
    assert asked[0][:3] == ("body", "fenders", 320.0)
    for more in ({"rope": [1]}, {"lines": [1]}, {"spreads": [1]}, {"simulation": SimpleNamespace(record=1)},
                 {"waves": SimpleNamespace(swell=[1], file=None)}, {"waves": SimpleNamespace(swell=[], file="f")},
                 {"conditions": lambda: SimpleNamespace(sea=None)}):  # fmt: skip
        assert berth.by_design_spectrum(study_at_quay(**more), None, "body", "hull", "fenders") == ""
    monkeypatch.setattr("hakobune.mooring.dolphins.at_quay.at_quay", lambda *given: None)
    assert berth.by_design_spectrum(study_at_quay(), None, "body", "hull", "fenders") == ""

    def none(*_):
        raise DolphinError("it yields")

    monkeypatch.setattr("hakobune.mooring.dolphins.at_quay.at_quay", none)
    assert berth.by_design_spectrum(study_at_quay(), None, "", "", "") == "design spectrum method: it yields"


# ------------------------------------------------------------------ pairs of waves


@dataclass
class Panels:
    lid: object = None
    mesh: object = "mesh"
    gravity: float = 9.81


@pytest.mark.parametrize("lid, highest, wanted", [(None, 2.01, "a lid"), (None, 1.99, None), ("own", 9.0, "own")])
def test_pairs_have_a_lid_where_their_waves_need_one_that_the_database_has_not(lid, highest, wanted, monkeypatch):
    """From ω²/g = 4/9.81 on"""
    monkeypatch.setattr("hakobune.bem.panels.irregular_frequencies.lid_needed_from", lambda mesh: 4.0 / 9.81)
    monkeypatch.setattr("hakobune.meshing.lid.lid", lambda mesh: "a lid")
    assert of_pairs._with_lid(Panels(lid), highest).lid == wanted


@pytest.mark.parametrize("change, fits", [
    ({}, True), ({"is_round": False}, False), ({"dimensions": {}}, False), ({"water_depth": math.inf}, False),
    ({"water_depth": 10.0 + 5.0 * 2.1}, False),
])  # fmt: skip
def test_a_cylinder_near_the_bed_is_solved_by_contours(change, fits, monkeypatch):
    """The gap over the smaller of radius and draft, 5 m of 8 and 5, up to what the method takes"""
    from hakobune.pipelines.scene.methods import METHODS

    monkeypatch.setattr("hakobune.bem.contour.short_waves.too_many", lambda sizes, k: sizes != (8.0, 5.0))
    most = METHODS["contour"].highest_gap
    db = {"bodies": (), "is_round": True, "dimensions": {"radius": 8.0, "draft": 5.0}, "gravity": 9.81,
          "water_depth": 5.0 + 5.0 * most * 0.999} | change  # fmt: skip
    if "water_depth" in change and math.isfinite(change["water_depth"]):
        db["water_depth"] = 5.0 + 5.0 * most * 1.01
    assert of_pairs._fits_contour(SimpleNamespace(**db), 1.0) == fits
    monkeypatch.setattr("hakobune.bem.contour.short_waves.too_many", lambda sizes, k: True)
    assert not of_pairs._fits_contour(SimpleNamespace(**db), 1.0)


def test_a_cylinder_of_pairs_has_the_sizes_and_water_of_its_database(monkeypatch):
    made = {}
    monkeypatch.setattr("hakobune.bem.methods.shape_problem.ShapeProblem", lambda **words: made.update(words))
    names = ("depth", "density", "gravity", "rotation_center", "inertia_matrix", "hydrostatic_stiffness", "viscous")
    panels = SimpleNamespace(**{name: name.upper() for name in names})
    of_pairs._cylinder(SimpleNamespace(dimensions={"radius": 8.0, "draft": 5.0}), panels, 1e-3)
    assert made == {"method": "contour", "shape": "buoy", "sizes": (8.0, 5.0), "tolerance": 1e-3} | {
        name: name.upper() for name in names
    }


FREE = SimpleNamespace(floats=True, name="")


def test_a_run_of_pairs_goes_on_where_it_was_ended_if_nothing_else_is_asked():
    other = SimpleNamespace(floats=True, name="stored")

    @dataclass
    class Asked:
        omega: object = None
        headings: object = None
        highest: object = None
        held: object = field(default_factory=lambda: FREE)
        level: object = None
        method: str = "auto"
        waves_given: bool = False

    forces = SimpleNamespace(omega="ω", headings="β", surface="yes")
    stored = SimpleNamespace(asked=0.4, held=other, forces=forces, method="contour")
    go_on = question.Question.continued
    found = go_on(Asked(), stored)
    assert (found.omega, found.headings, found.highest, found.level, found.method) == ("ω", "β", 0.4, "full", "contour")
    assert found.held is other
    forces.surface = None
    named = SimpleNamespace(floats=True, name="lines")
    found = go_on(Asked(held=named, level="body", method="panel"), stored)
    assert (found.held, found.level, found.method) == (named, "body", "panel")
    for one in (Asked(waves_given=True), Asked(held=SimpleNamespace(floats=False, name=""))):
        assert go_on(one, stored) is one
    stored.asked = None
    one = Asked()
    assert go_on(one, stored) is one


@pytest.mark.parametrize("there, asked, kept", [(25, 40, 1), (25, 12, 1), (3, 40, 0), (40, 40, 2)])
def test_a_run_of_pairs_begins_with_whole_blocks_of_what_is_stored(there, asked, kept, monkeypatch):
    @dataclass
    class Stored:
        forces: object
        coarser: object = None

    block = running.BLOCK
    there, asked = there * block // 20, asked * block // 20
    monkeypatch.setattr(running, "frequencies_of", lambda omega, highest, kind: [0] * asked)
    forces = SimpleNamespace(surface=None, frequency=[0] * there, kind="k", first=lambda count: count)
    given = Stored(forces, list(range(there)))
    found = running._begun(given, SimpleNamespace(omega=0, highest=0), False)
    count = min(there, asked) // block * block
    if count:
        assert found.forces == count and found.coarser == list(range(count))
    else:
        assert found is None
    assert running._begun(given, SimpleNamespace(omega=0, highest=0), True) is None
    assert running._begun(None, None, False) is None and kept >= 0


@pytest.mark.parametrize("words, kept", [("no way around the surface", True), ("no inertia", False)])
def test_a_surface_that_cannot_be_gone_around_is_told_and_its_share_is_unknown(words, kept, monkeypatch):
    def failing(*_):
        raise ValueError(words)

    monkeypatch.setattr(running, "surface_share", failing)
    asked = SimpleNamespace(waves=(1, 2), held=SimpleNamespace(moving=True), highest=0.4)
    stored = SimpleNamespace(asked=0.4, forces=SimpleNamespace(surface=None), share=0.03)
    assert running._share(None, asked, stored) == 0.03
    stored.asked = 0.5
    if kept:
        with pytest.warns(UserWarning, match=words):
            assert running._share(None, asked, stored) is None
    else:
        with pytest.raises(ValueError, match=words):
            running._share(None, asked, stored)
    monkeypatch.setattr(running, "surface_share", lambda *given: given)
    assert running._share("p", asked, None) == ("p", 1, 2, True)


# ------------------------------------------------------------------ imported bodies, lines, bottoms


@pytest.mark.parametrize("body, names, words", [
    ({}, (), "x.h5: 3 frequencies, no motions: give --gyration kxx,kyy,kzz"),
    ({"mass": 1234567.0, "center_of_mass": (1.0, 0.0, -2.5)}, ("rao",),
     "x.h5: 3 frequencies, mass 1.23457e+06 kg, centre of gravity 1, 0, -2.5 m, motions"),
])  # fmt: skip
def test_a_weighed_database_is_told_in_a_line(body, names, words):
    db = SimpleNamespace(header=SimpleNamespace(body=body), path="x.h5", omega=[1, 2, 3], names=names)
    assert _line(db) == words


def test_a_table_of_motions_fades_in_about_its_mean_from_0_on():
    """x³ (10 − 15 x + 6 x²): ½ half way; nothing before 0 s, all after the ramp; rows before 0 s are not in the mean"""
    time = np.array([-4.0, 0.0, 5.0, 10.0, 15.0])
    place = np.array([[90.0, 0, 0], [0.0, 1, 2], [4.0, 1, 2], [8.0, 1, 2], [4.0, 1, 2]])
    found = faded(time, place, 10.0)
    assert found[:, 0] == pytest.approx([4.0, 4.0, 4.0, 8.0, 4.0]) and faded(time, place, 0) is place
    place[2] = 10.0, 1, 2
    mean = (0 + 10 + 8 + 4) / 4
    assert faded(time, place, 10.0)[2, 0] == pytest.approx(mean + 0.5 * (10 - mean))


def test_a_bed_rises_to_where_it_is_told_or_lies_along_its_line():
    table = SimpleNamespace(uphill_deg=30.0, points=[])
    study = SimpleNamespace(anchor=(1.0, 2.0, -20.0), fairlead=SimpleNamespace(position=(4.0, 6.0, 0.0)))
    assert parts._uphill(study, table) == pytest.approx(math.pi / 6)
    table.uphill_deg = None
    assert parts._uphill(study, table) == 0.0
    table.points = [(0, 0), (10, 1)]
    assert parts._uphill(study, table) == pytest.approx(math.atan2(4.0, 3.0))
    study.fairlead.position = None
    with pytest.raises(
        StudyError, match=r"bed.points need a direction if the fairlead has a table; give bed.uphill_deg"
    ):
        parts._uphill(study, table)


def test_bottoms_of_bodies_that_move_are_in_their_own_axes(monkeypatch):
    """A body at (10, 5) headed to 90°: what lies 3 m to its bow is at (10, 8)"""
    monkeypatch.setattr(places, "corners_of_bottom", lambda points: np.array([[10.0, 8.0, -2.0]]))
    mesh = SimpleNamespace(whole=lambda: SimpleNamespace(points=None))
    axes = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    fixed, free = (SimpleNamespace(fixed=fixed, name=name, place=(10.0, 5.0), axes=axes) for fixed, name in (
        (True, "pier"), (False, "ship")))  # fmt: skip
    db = SimpleNamespace(bodies=[fixed, free], mesh=mesh)
    monkeypatch.setattr(places, "each_body", lambda db: [SimpleNamespace(mesh=mesh)] * 2)
    ((name, corners),) = places._bottoms(db)
    assert name == "ship" and corners == pytest.approx(np.array([[3.0, 0.0, -2.0]]))
    db.bodies = []
    ((name, corners),) = places._bottoms(db)
    assert name == "" and corners[0, 1] == 8.0


# ------------------------------------------------------------------ the pace of many pieces


def test_each_frequency_of_sections_side_by_side_is_counted(monkeypatch):
    """Three frequencies of a section that is held: three steps of the pace, with the words of what takes long"""
    import hakobune
    from hakobune.pipelines.sections import side_by_side

    steps, made = [], []

    class Pace:
        def __init__(self, *given):
            made.append(given)

        def step(self):
            steps.append(1)

    monkeypatch.setattr(side_by_side, "Pace", Pace)
    study = {"omegas": [0.5, 0.7, 0.9], "water": {"depth": 20.0},
             "sections": [{"name": "a", "beam": 12.0, "draft": 3.0, "y": 0.0, "fixed": True}]}  # fmt: skip
    found = hakobune.sections(study)
    assert len(steps) == 3 and made == [("3 frequencies take", 3, "give fewer omegas")]
    assert found["waves.reflection"] ** 2 + found["waves.transmission"] ** 2 == pytest.approx(np.ones(3), abs=1e-3)


def test_a_pace_is_told_after_a_second_and_then_every_ten(monkeypatch):
    """The first piece loads and compiles: 9 of 10 pieces in 3 s after it are 3.33 s; later what is left"""
    from hakobune.pipelines.common import bounds

    clock, said, checked = [100.0], [], []
    monkeypatch.setattr(bounds.time, "perf_counter", lambda: clock[0])
    monkeypatch.setattr(
        bounds, "check_seconds", lambda what, seconds, way_out: checked.append((what, seconds, way_out))
    )
    monkeypatch.setattr(bounds, "told", lambda what, seconds, say: said.append(seconds))
    pace = bounds.Pace("pieces take", 1000, "give fewer", said.append)
    for now in (150.0, 150.5, 151.5, 155.0, 161.4, 161.6):
        clock[0] = now
        pace.step()
    assert checked == [("pieces take", 1.5 / 2 * 1000, "give fewer")] and said[0] == 750.0
    whole = (161.6 - 150.0) / 5 * 1000
    assert len(said) == 2 and said[1] == f"6 of 1000, {bounds.duration(whole - 11.6)} left"
