"""Loads of single-point studies in SI units, what is refused and told of them, and the places of maps."""

import copy
import math
import re
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest
from test_head_on_by_hand import BEAM, BOW, DRAFT, HEIGHT, LENGTH, STUDY

from hakobune.mooring.loads.ship_derivatives import clarke
from hakobune.mooring.loads.turning import turning_coefficients
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.single_point import loads, maps
from hakobune.pipelines.single_point import study as studies
from hakobune.pipelines.single_point.tables import make_study

RHO = 1025.0
RAW = tomllib.loads(STUDY)
BOX = RHO * LENGTH * BEAM * DRAFT  # kg


def raw(**changes):
    """The study with other numbers: {"current.yaw_drag": …}, None to leave one out"""
    made = copy.deepcopy(RAW)
    for key, value in changes.items():
        *path, name = key.split("__")
        table = made
        for part in path:
            table = table.setdefault(part, {})
        if value is None:
            table.pop(name, None)
        else:
            table[name] = value
    return made


def found(center=(0.0, 0.0), added=0.1 * BOX, db=None, **changes):
    mass = np.diag([BOX + added, 2 * BOX, 1e12])
    return loads.loads_of(make_study(raw(**changes)), db, RHO, np.array(center), mass)


def water(**changes):
    return found(**changes)[0].water


def test_damping_of_the_water_is_in_newtons():
    """kN s/m and kN m s times 1000; the yaw drag that is given too"""
    made = water(current__yaw_drag=7e5)
    assert np.diag(made.linear) == pytest.approx([0.0, 500e3, 2e9]) and made.quadratic == pytest.approx(7e8)
    assert water(current__sway_damping=0.0, current__yaw_damping=0.0).linear is None
    assert (made.turning, made.length) == (False, LENGTH)
    for key in ("yaw_drag", "sway_damping", "yaw_damping"):
        water(**{f"current__{key}": 0.0})
        for value in (-1.0, math.inf):
            with pytest.raises(StudyError, match=f"current.{key} is .*; allowed: at least 0, finite"):
                water(**{f"current__{key}": value})


def test_the_yaw_rate_pushes_with_the_derivatives_of_the_box_or_those_that_are_given():
    """Ahead, ½ρL² Y'_r + m_x/L and ½ρL³ N'_r; Clarke's of a block of what is displaced"""
    made = water(current__yaw_rate={})
    own = clarke(LENGTH, BEAM, DRAFT, 1.0)
    half = 0.5 * RHO * LENGTH**2
    astern = np.argmin(np.cos(loads.angles()))  # the water flows to the stern
    assert made.table[astern, 1] == pytest.approx([0, half * own.Y_r + 0.1 * BOX / LENGTH, half * LENGTH * own.N_r])
    given = water(current__yaw_rate={"Y_r": 0.01, "N_r": -0.02}, hull__displacement=0.8e-3 * BOX)
    assert given.table[astern, 1] == pytest.approx([0, half * 0.01 + 0.3 * BOX / LENGTH, -0.02 * half * LENGTH])
    lighter = water(current__yaw_rate={}, hull__displacement=0.8e-3 * BOX)
    assert lighter.table[astern, 1, 2] == pytest.approx(half * LENGTH * clarke(LENGTH, BEAM, DRAFT, 0.8).N_r)
    for N in (0.0, -1.0):
        water(current__yaw_rate={"N_r": N})
    for name, value in (("N_r", 1e-3), ("N_r", -math.inf), ("Y_r", math.inf)):
        with pytest.raises(StudyError, match=f"current.yaw_rate.{name} is {value:g}; allowed: finite, N_r at most 0"):
            water(current__yaw_rate={name: value})


@pytest.mark.parametrize("share, good", [(1.0, True), (1.001, False)])
def test_a_hull_displaces_at_most_its_box(share, good):
    if good:
        water(current__yaw_rate={}, hull__displacement=share * BOX / 1e3)
        return
    with pytest.raises(StudyError, match=r"hull.displacement fills 1 of length, beam and draft; allowed: at most 1"):
        water(current__yaw_rate={}, hull__displacement=share * BOX / 1e3)


def turning(**more):
    return {"current__coefficients": None, "current__sway_damping": 0.0, "current__yaw_damping": 0.0,
            "current__turning": more}  # fmt: skip


def test_turning_tests_are_of_the_hull_s_proportions_or_of_those_that_are_given():
    own = {"length_over_beam": LENGTH / BEAM, "beam_over_draft": BEAM / DRAFT, "depth_over_draft": 50.0 / DRAFT}
    tested = {"length_over_beam": 2.0, "beam_over_draft": 10.0, "depth_over_draft": 8.0}
    load, told = found(**turning(**tested))
    assert load.water.turning and load.water.height == pytest.approx(-0.5 * DRAFT)
    for name, value in tested.items():
        said = f"the turning tests were made with {name} = {value:g}, but the hull has {own[name]:.3g}"
        assert (said in told) is not math.isclose(value, own[name])
    assert water(**turning(**tested), current__center_z=-3.0).height == -3.0


@pytest.mark.parametrize(("depth", "unsafe"), [(1.6, True), (7.9, False)])
def test_turning_tests_of_deeper_water_are_told_as_unsafe(depth, unsafe):
    """C = C₀ + (3.2 − C₀)(T/d)² over C₀ (UFC 4-159-03, eq. 11); C₀ of the tests across the flow"""
    tested = {"length_over_beam": 2.0, "beam_over_draft": 10.0, "depth_over_draft": 8.0}
    _, told = found(water__depth=depth * DRAFT, **turning(**tested))
    said = [one for one in told if one.startswith("unsafe: ")]
    assert bool(said) is unsafe
    if unsafe:
        deep = abs(float(turning_coefficients(2.0, 10.0, 8.0).C_y(math.pi / 2, 0.0)))
        assert f"about {1 + (3.2 / deep - 1) / depth**2:.2g} times as hard" in said[0]


def test_all_that_is_wrong_with_the_loads_is_told_at_once():
    with pytest.raises(StudyError, match=r"outside the turning tests.*; and waves: the wave drift is unknown"):
        found(**turning(), waves__drift_tonf_per_m2=None)


def test_turning_tests_hold_other_numbers_already_and_are_about_midship():
    tested = {"length_over_beam": 2.0, "beam_over_draft": 10.0, "depth_over_draft": 8.0}
    for key in ("yaw_drag", "sway_damping", "yaw_damping"):
        with pytest.raises(StudyError, match=f"current.{key} is given with turning tests, which already contain it;"):
            found(**turning(**tested) | {f"current__{key}": 1.0})
    for center in ((1.0, 0.0), (0.0, 1.0)):
        with pytest.raises(
            StudyError,
            match=r"turning tests refer to midship, but hull\.center is not at midship; give current coefficients or "
            r"a file",
        ):
            found(center=center, **turning(**tested))
    with pytest.raises(StudyError, match="turning and coefficients are given, and each defines the force"):
        found(current__turning=tested)


def test_drift_of_a_coefficient_is_of_the_square_of_the_height_along_the_waves():
    load, _ = found(waves__drift_tonf_per_m2=2.5)
    pull = 2.5 * 9806.65 * HEIGHT**2
    assert np.hypot(*load.drift.table[:, :2].T) == pytest.approx(np.full(720, pull))
    ahead = load.drift.table[0]  # heading 0, waves from the bow
    assert ahead == pytest.approx([-pull, 0, 0], abs=1e-6 * pull)
    for value in (-1e-3, math.inf):
        with pytest.raises(StudyError, match=r"waves.drift_tonf_per_m2 is .*; allowed: at least 0"):
            found(waves__drift_tonf_per_m2=value)
    found(waves__drift_tonf_per_m2=0.0)
    with pytest.raises(StudyError, match=r"waves.height is missing"):
        found(waves__height=None)
    with pytest.raises(StudyError, match="waves: the wave drift is unknown; give --database or drift_tonf_per_m2"):
        found(waves__drift_tonf_per_m2=None)
    empty = SimpleNamespace(reader=SimpleNamespace(knows_drift=False))
    with pytest.raises(StudyError, match="the database contains no drift; solve it with"):
        found(waves__drift_tonf_per_m2=None, db=empty)


@pytest.mark.parametrize("period, height, says", [
    (None, 23.9, ""), (None, 24.1, "the highest of 1000 waves, 44.8 m, breaks at 44.6 m"),
    (None, 30.1, r"0\.6 of the water depth 50 m"), (None, 44.5, "of the water depth 50 m"),
    (None, 44.7, r"refused: significant height is 44\.7 m, but single waves break at 44\.6\d m in 50 m"),
    (6.0, 4.2, ""), (6.0, 4.4, "the highest of 1000 waves, 8.18 m, breaks at 7.98 m"),
    (6.0, 8.0, r"refused: significant height is 8 m at a peak period of 6 s, but single waves break at 7\.978"),
])  # fmt: skip
def test_waves_that_break_are_told_or_refused_as_by_other_commands(period, height, says):
    """0.6 h and 0.142 · 2π h of any period in 50 m; 0.142 g T²/2π = 7.98 m of 6 s, half of it of a thousand waves"""
    given = {"waves__drift_tonf_per_m2": 1.0, "waves__height": height, "waves__peak_period": period}
    given |= {f"waves__{key}": None for key in ("mean_period", "period")}
    if says.startswith("refused"):
        with pytest.raises(ValueError, match=says.removeprefix("refused: ")):
            found(**given)
        return
    told = [line for line in found(**given)[1] if "of the water depth" in line or "breaks at" in line]
    assert len(told) == bool(says) and all(re.search(says, line) for line in told)


def test_drift_on_a_current_is_told_beside_that_of_still_water():
    """5 = √(3² + 4²) kN at one heading, 2 in still water"""
    on, still = np.array([[3e3, 4e3, 9e9], [1e3, 0, 0]]), np.array([[2e3, 0, 9e9], [0, 1e3, 0]])
    said = loads._by_current(on, still, SimpleNamespace(waves="absolute"))
    assert said == (
        "on the current the mean drift of the waves is at most 5 kN, and 2 kN in still "
        'water (current.waves = "still"); waves are given in absolute frequencies'
    )


@pytest.mark.parametrize("share, told", [(0.99, False), (1.01, True)])
def test_drift_that_is_uncertain_between_stored_waves_is_told(monkeypatch, share, told):
    omega = np.linspace(0.3, 1.2, 50)
    monkeypatch.setattr(loads, "frequencies", lambda body: omega)
    value, error = (np.full((50, 1, 3), size) for size in (-2e3, 2e3 * share * loads.UNSURE))
    body = SimpleNamespace(at=lambda w, name, ways: (value, error))
    sea = SimpleNamespace(spectrum=SimpleNamespace(density=lambda w: np.exp(-w)))
    said = list(loads._between_waves(body, sea))
    assert len(said) == told
    percent = 100 * share * loads.UNSURE
    assert all(f"uncertain by {percent:.3g} % between stored waves; limit {100 * loads.UNSURE:g} %" in s for s in said)


def test_another_slenderness_keeps_the_waterplane_and_the_attachment_s_share():
    """L = √(A · 8), B = √(A/8)"""
    made = maps.with_value(RAW, maps.SLENDERNESS, 8.0)
    area = LENGTH * BEAM
    assert (made["hull"]["length"], made["hull"]["beam"]) == pytest.approx((math.sqrt(8 * area), math.sqrt(area / 8)))
    assert made["attachment"]["x"] == pytest.approx(BOW * math.sqrt(8 * area) / LENGTH)
    assert made["hull"]["draft"] == DRAFT and RAW["hull"]["length"] == LENGTH
    with pytest.raises(StudyError, match=r"hull.length_over_beam is 0; allowed: above 0"):
        maps.with_value(RAW, maps.SLENDERNESS, 0.0)


def mapped(monkeypatch, axes, fails=lambda made: False):
    """`Map` of a study whose growth is hawser.length + 1000 wind.speed"""

    def make(study, db):
        return SimpleNamespace(point=(study.hawser.length, study.wind.speed))

    def answer(point):
        if fails(point):
            raise ValueError(f"none at\n{point[0]:g}")
        slewing = SimpleNamespace(growth=point[0] + 1000 * point[1], period=point[0])
        return SimpleNamespace(slewing=slewing, heading=math.radians(point[1]))

    for name, by in (("make", make), ("equilibria", lambda point: point), ("preferred", answer)):
        monkeypatch.setattr(maps, name, by)
    return maps.computed(
        raw() | {"maps": [{"x": {"key": "wind.speed", "from": 1, "to": 2, "count": 2}}, axes]}, 1, None
    )


X = {"key": "hawser.length", "from": 10.0, "to": 30.0, "count": 3}
Y = {"key": "wind.speed", "from": 5.0, "to": 6.0, "count": 2}


def test_maps_hold_the_answer_of_every_place(monkeypatch):
    made = mapped(monkeypatch, {"x": X, "y": Y})
    assert made.keys == ("hawser.length", "wind.speed") and list(made.x) == [10, 20, 30] and list(made.y) == [5, 6]
    assert made.growth == pytest.approx(np.array([[5010, 5020, 5030], [6010, 6020, 6030]]))
    assert made.period == pytest.approx(np.array([[10, 20, 30]] * 2))
    assert made.heading == pytest.approx(np.array([[5.0] * 3, [6.0] * 3])) and made.failed == 0


def test_places_without_an_answer_are_left_empty_and_counted(monkeypatch):
    speed = RAW["wind"]["speed"]
    made = mapped(monkeypatch, {"x": X}, lambda point: point[0] > 15)
    assert made.growth == pytest.approx(np.array([[10 + 1000 * speed, np.nan, np.nan]]), nan_ok=True)
    assert (made.failed, made.reason, len(made.y)) == (2, "none at 20", 1) and np.isnan(made.y[0])
    with pytest.raises(StudyError, match=r"maps\[1\]: no point could be computed: none at 10"):
        mapped(monkeypatch, {"x": X}, lambda point: True)


def test_maps_have_ten_thousand_places_at_most(monkeypatch):
    monkeypatch.setattr(maps, "MOST", 6)
    mapped(monkeypatch, {"x": X, "y": Y})
    monkeypatch.setattr(maps, "MOST", 5)
    with pytest.raises(StudyError, match=r"maps\[1\] has 6 points; allowed: at most 5"):
        mapped(monkeypatch, {"x": X, "y": Y})


@pytest.mark.parametrize("center", [(0.0, 0.0), (4.0, -1.5)])
def test_hawsers_end_beside_the_attachment_which_is_measured_from_the_centre_of_mass(center):
    """Two of them half of their spacing to port and to starboard; a buoy at the hull has no length"""
    at = {"attachment__x": 40.0, "attachment__y": 2.0}
    one = make_study(raw(**at, hawser={"length": 30.0}))
    two = make_study(raw(**at, hawser={"length": 30.0, "count": 2, "spacing": 5.0}))
    none = make_study(raw(**at, hawser=None))
    middle = np.array([40.0 - center[0], 2.0 - center[1]])
    for study, ends, lengths in ((one, [middle], [30.0]), (none, [middle], [0.0]),
                                 (two, [middle + [0, 2.5], middle - [0, 2.5]], [30.0, 30.0])):  # fmt: skip
        found = studies._hawsers(study, np.array(center))
        assert found[0] == pytest.approx(np.array(ends)) and found[1].tolist() == lengths


# ------------------------------------------------------------------ round hulls

ROUND = {"hull__length": 20.0, "hull__beam": 20.0, "hull__draft": 8.0, "current__coefficients": None,
         "current__sway_damping": 0.0, "current__yaw_damping": 0.0, "wind__coefficients": None}  # fmt: skip


def test_a_round_hull_is_pulled_along_the_stream_as_a_cylinder():
    """½ρ 1.05 D d of the current and ½ρ_a 0.5 D f of the wind from any side, without a moment"""
    study = make_study(raw(**ROUND))
    load, told = loads.loads_of(study, None, RHO, np.zeros(2), np.eye(3), is_round=True)
    at = loads.angles()
    along = np.stack([np.cos(at), np.sin(at), 0 * at], axis=1)
    assert load.water.table[:, 0] == pytest.approx(0.5 * RHO * 1.05 * 20 * 8 * along, abs=1e-9)
    assert load.wind.table == pytest.approx(0.5 * 1.226 * 0.5 * 20 * study.hull.freeboard * along, rel=1e-3, abs=1e-9)
    assert load.water.at_rest == pytest.approx(0.5 / 1.05)
    assert len(told) == 1 and told[0].startswith("current force: C_D 1.05 of a rough cylinder on the round hull")


def test_a_round_hull_in_water_at_rest_needs_no_turning_tests():
    study = make_study(raw(**ROUND, current=None))
    load, _ = loads.loads_of(study, None, RHO, np.zeros(2), np.eye(3), is_round=True)
    assert not load.water.turning and load.water.speed == 0
    assert load.water.force(0.3, 0.0, 0.0) == pytest.approx([-0.5 * RHO * 0.5 * 20 * 8 * 0.09, 0, 0], abs=1e-6)
    with pytest.raises(StudyError, match=r"give current.turning"):
        loads.loads_of(study, None, RHO, np.zeros(2), np.eye(3))


def test_the_mass_of_a_round_hull_is_that_of_a_cylinder_and_its_length_its_beam():
    made = studies.make(make_study(raw(**ROUND, attachment__x=10.0)), is_round=True)
    own = RHO * math.pi * 100 * 8
    assert np.diag(made.point.mass) == pytest.approx([1.1 * own, 1.6 * own, 1.4 * own * 50.0])
    longer = raw(**ROUND | {"hull__length": 20.5}, attachment__x=10.0)
    with pytest.raises(StudyError, match=r"hull.length is 20.5 m and hull.beam 20 m, but the hull of the database is"):
        studies.make(make_study(longer), is_round=True)


@pytest.mark.parametrize("beam, good", [(20.0, True), (19.9, False)])
def test_a_round_hull_has_the_diameter_of_its_scene(beam, good):
    db = SimpleNamespace(dimensions={"radius": 10.0, "draft": 8.0}, water_depth=50.0)
    study = make_study(raw(**ROUND | {"hull__beam": beam}))
    if good:
        studies.check_database(study, db)
        return
    with pytest.raises(StudyError, match=r"hull.beam is 19.9 m, but the database is for 20 m"):
        studies.check_database(study, db)
