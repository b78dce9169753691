"""Tables of lines, quays and streams of studies: SI values by hand, and what is said beyond each limit."""

import math
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from hakobune.pipelines.common.line_tables import LineTable, MaterialTable, TypeTable, check_types, line_of, line_type
from hakobune.pipelines.common.quantities import StudyError, direction, one_of, speed
from hakobune.pipelines.common.quay_tables import DolphinTable, QuayFenderTable, RopeTable, berth_of_tables
from hakobune.pipelines.common.weather.gusts import gusts_of
from hakobune.pipelines.common.weather.streams import WindTable

HULL = SimpleNamespace(length=100.0, beam=50.0, draft=10.0, freeboard=8.0, is_round=False)
G = 9.80665


def typed(kind, table):
    return msgspec.convert(table, kind)


def line(table, types, **more):
    types = {name: typed(TypeTable, one) for name, one in types.items()}
    return line_of("lines[0]", "one", typed(LineTable, table), types, ("a", "b"), **more)


CHAIN = {"weight_kg_per_m": 100.0, "axial_stiffness_tonf": 5e4, "breaking_load_tonf": 500.0, "bed_friction": 0.6}
WIRE = {"weight_N_per_m": 300.0, "axial_stiffness_kN": 1e5, "breaking_load_kN": 2000.0, "bed_friction": 0.6}


def test_weights_stiffnesses_and_loads_come_in_kilograms_tonnes_force_newtons_and_kilonewtons():
    chain = line_type("types.chain", typed(MaterialTable, {k: v for k, v in CHAIN.items() if k != "bed_friction"}))
    assert (chain.weight, chain.axial_stiffness, chain.breaking_load) == pytest.approx((100 * G, 5e7 * G, 5e5 * G))
    wire = line_type("types.wire", typed(MaterialTable, {k: v for k, v in WIRE.items() if k != "bed_friction"}))
    assert (wire.weight, wire.axial_stiffness, wire.breaking_load) == (300.0, 1e8, 2e6)
    spliced = line_type(
        "types.wire", typed(MaterialTable, {"catalogue": "wire 6x24 FC G 40 mm", "termination": "splice"})
    )
    assert spliced.breaking_load == pytest.approx(0.8 * 0.28 * 1600 * 1470)
    chain = {"catalogue": "R3 studless 80 mm", "corrosion_mm": 8.0, "efficiency": 0.5}  # half of what 72 mm carry
    worn = line_type("types.chain", typed(MaterialTable, chain))
    assert worn.breaking_load == pytest.approx(0.5 * 0.0223e3 * 72**2 * (44 - 0.08 * 72))
    for wrong, words in (
        ({"termination": "knot"}, "termination is 'knot'; allowed: socket, .*, or efficiency"),
        ({"termination": "clips", "efficiency": 0.9}, "termination and efficiency are both given; give one of them"),
        ({"efficiency": 1.1}, "efficiency is 1.1; allowed: above 0, at most 1"),
        ({"corrosion_mm": 1.0}, "corrosion_mm is given without a chain"),
        ({**chain, "corrosion_mm": 50.0}, "corrosion_mm: .*at least half of the diameter"),
    ):
        with pytest.raises(StudyError, match=words):
            line_type("types.x", typed(MaterialTable, {"weight_N_per_m": 1.0, "breaking_load_kN": 1.0} | wrong))
    bare = line_type("types.bare", typed(MaterialTable, {"weight_N_per_m": 1.0}))
    assert math.isinf(bare.axial_stiffness) and math.isinf(bare.breaking_load)


def test_a_line_of_segments_has_its_bodies_at_their_joints_and_the_friction_of_its_types():
    """A clump of 5 t of 1 m³: g (5000 − 1025) N after the first 100 m"""
    made = line(
        {"segments": [{"type": "chain", "length": 100.0}, {"type": "wire", "length": 200.0}],
         "bodies": [{"after_segment": 1, "mass": 5000.0, "volume": 1.0}]},
        {"chain": CHAIN, "wire": WIRE}, density=1025.0, gravity=G,
    )  # fmt: skip
    assert [segment.length for segment in made.segments] == [100.0, 200.0]
    assert [segment.weight for segment in made.segments] == pytest.approx([100 * G, 300.0])
    (load,) = made.loads
    assert load.position == 100.0 and load.weight == pytest.approx(G * (5000 - 1025))
    assert made.bed_friction == 0.6


LINES = [
    ({"type": "chain", "length": 1e5}, {"type": "chain", "length": 100001.0},
     "length is 100001; allowed: above 0, at most"),
    ({"type": "chain", "length": 10.0}, {"type": "chain"}, "give either type and length, or segments"),
    ({"type": "chain", "length": 10.0}, {"type": "rope", "length": 10.0}, "type is 'rope'; allowed: chain, wire"),
    ({"segments": [{"type": "chain", "length": 10.0}] * 2, "bodies": [{"after_segment": 1, "mass": 1.0}]},
     {"segments": [{"type": "chain", "length": 10.0}] * 2, "bodies": [{"after_segment": 2, "mass": 1.0}]},
     "bodies[0].after_segment is 2; allowed: 1 to 1"),
    ({"segments": [{"type": "chain", "length": 10.0}] * 2, "bodies": [{"after_segment": 1, "mass": 0.0}]},
     {"segments": [{"type": "chain", "length": 10.0}] * 2, "bodies": [{"after_segment": 1, "mass": -1.0}]},
     "bodies[0].mass is -1; allowed: at least 0"),
    ({"segments": [{"type": "chain", "length": 10.0}] * 3, "bodies": [{"after_segment": n,
     "mass": 1.0} for n in (1, 2)]},
     {"segments": [{"type": "chain", "length": 10.0}] * 3, "bodies": [{"after_segment": 1, "mass": 1.0}] * 2},
     "after_segment is 1, a joint that has another body"),
    ({"type": "chain", "length": 10.0, "bed": {"friction": 5.0}}, {"type": "chain", "length": 10.0,
     "bed": {"friction": 5.1}},
     "bed.friction is 5.1; allowed: 0 to 5"),
]  # fmt: skip


@pytest.mark.parametrize("good, bad, says", LINES, ids=lambda value: value[:30] if isinstance(value, str) else "")
def test_a_line_is_taken_up_to_its_limits(good, bad, says):
    types = {"chain": CHAIN, "wire": WIRE}
    line(good, types)
    with pytest.raises(StudyError) as refused:
        line(bad, types)
    assert says in str(refused.value)


@pytest.mark.parametrize("weight, good", [(1e6, True), (1.001e6, False), (0.0, False)])
def test_a_line_weighs_up_to_a_million_newtons_a_metre(weight, good):
    kinds = {"heavy": typed(TypeTable, {"weight_N_per_m": weight})}
    if good:
        check_types(kinds)
        return
    with pytest.raises(StudyError, match="heavy"):
        check_types(kinds)


def test_segments_of_other_friction_need_the_friction_of_the_line():
    rough = CHAIN | {"bed_friction": 0.9}
    segments = {"segments": [{"type": "chain", "length": 10.0}, {"type": "wire", "length": 20.0}]}
    with pytest.raises(
        StudyError,
        match=r"bed_friction of its types is 0\.6 to 0\.9, but a line has only one friction; "
        r"give bed\.friction",
    ):
        line(segments, {"chain": rough, "wire": WIRE})
    assert line(segments | {"bed": {"friction": 0.3}}, {"chain": rough, "wire": WIRE}).bed_friction == 0.3


def test_a_hawser_pulls_by_its_table_in_per_cent_of_its_length_and_a_spring_by_its_stiffness():
    made = line(
        {"type": "nylon", "length": 40.0}, {"nylon": {"elongation_percent": [0, 10, 20], "tension_tonf": [0, 10, 30]}}
    )
    assert float(made.pull.reaction(4.0)) == pytest.approx(10e3 * G) and float(
        made.pull.reaction(8.0)
    ) == pytest.approx(30e3 * G)
    spring = line({"type": "spring", "length": 40.0}, {"spring": {"spring_kN_per_m": 12.0}})
    assert float(spring.pull.reaction(2.5)) == pytest.approx(30e3)


def fender(**more):
    return typed(QuayFenderTable, {"name": "F", "position": [0.0, 25.0, 1.0], "family": "cell", "height": 1.7} | more)


@pytest.mark.parametrize("position, normal, side", [([10, 26, 1], [0, 1, 0], 25.0), ([10, -26, 1], [0, -1, 0], 25.0),
                                                    ([51, 3, 1], [1, 0, 0], 50.0), ([-50.5, 3, 1],
                                                     [-1, 0, 0], 50.0)])  # fmt: skip
def test_a_fender_is_met_by_the_side_of_the_hull_that_it_stands_before(position, normal, side):
    (made,) = berth_of_tables(
        [fender(position=position, friction=0.3, shear=2000.0)], [], [], HULL, np.zeros(3)
    ).fenders
    assert list(made.normal) == normal and made.side == side
    assert made.friction == 0.3 and made.shear == 2e6


PLACES = [
    ([10, 35, 1], [10, 35.1, 1]),
    ([10, 26, 8], [10, 26, 8.1]),
    ([10, 26, -10], [10, 26, -10.1]),
    ([50, 26, 1], [51, 26, 1]),
]


@pytest.mark.parametrize("good, bad", PLACES)
def test_a_fender_stands_at_most_ten_metres_off_and_within_the_side(good, bad):
    berth_of_tables([fender(position=good)], [], [], HULL, np.zeros(3))
    with pytest.raises(StudyError, match="the body cannot reach"):
        berth_of_tables([fender(position=bad)], [], [], HULL, np.zeros(3))


def test_dolphins_carry_one_fender_each_in_series_with_it():
    """A fender of k and a dolphin of κ: 1/k' = 1/k + 1/κ at small loads"""
    dolphin = typed(DolphinTable, {"name": "D", "stiffness": 8000.0})
    alone = berth_of_tables([fender()], [], [], HULL, np.zeros(3)).fenders[0].fender
    made = berth_of_tables([fender(on="D")], [dolphin], [], HULL, np.zeros(3)).fenders[0].fender
    force = 50e3
    x = np.interp(force, [float(alone.loading(d)) for d in np.linspace(0, 0.05, 501)], np.linspace(0, 0.05, 501))
    assert float(made.loading(x + force / 8e6)) == pytest.approx(force, rel=1e-3)
    for fenders, dolphins, says in (
        ([fender(on="E")], [dolphin], "there is no dolphin 'E'; allowed: D"),
        ([fender(on="D"), fender(name="G", on="D")], [dolphin], "carries 2 fenders; allowed: one"),
        ([fender()], [dolphin], "dolphin 'D' carries no fender"),
        ([fender(on="D")], [dolphin, typed(DolphinTable, {"name": "E", "stiffness": 1.0})], "dolphin 'E' carries no"),
        ([fender(on="D")], [dolphin, dolphin], "two [[dolphin]] have the same name; give each a name of its own"),
        ([fender(on="D", dolphin=5000.0)], [dolphin], "on and dolphin are both given; give one of them"),
    ):
        with pytest.raises(StudyError) as refused:
            berth_of_tables(fenders, dolphins, [], HULL, np.zeros(3))
        assert says in str(refused.value)


def test_a_rope_has_its_pretension_at_rest_and_a_tail_needs_its_strain():
    table = {"name": "head", "fairlead": [50.0, 20.0, 5.0], "bollard": [70.0, 40.0, 5.0], "breaking_load_kN": 1000.0,
             "break_strain": 0.1, "pretension_kN": 100.0}  # fmt: skip
    (made,) = berth_of_tables([], [], [typed(RopeTable, table)], HULL, np.zeros(3)).ropes
    length = math.hypot(20, 20) / (1 + 0.1 * 100 / 1000)  # straight, of T = B ε/0.1
    assert made.length == pytest.approx(length, rel=1e-6)
    with pytest.raises(StudyError, match="tail_break_strain is missing"):
        berth_of_tables([], [], [typed(RopeTable, table | {"tail_length": 8.0})], HULL, np.zeros(3))


def test_a_rope_takes_forces_in_tonf_as_in_kN_but_not_in_both():
    table = {"name": "head", "fairlead": [50.0, 20.0, 5.0], "bollard": [70.0, 40.0, 5.0], "break_strain": 0.1,
             "tail_length": 10.0, "tail_break_strain": 0.3}  # fmt: skip

    def made(**forces):
        return berth_of_tables([], [], [typed(RopeTable, table | forces)], HULL, np.zeros(3)).ropes[0]

    tonf = made(breaking_load_tonf=100.0, pretension_tonf=10.0, tail_breaking_load_tonf=80.0)
    kilo = made(breaking_load_kN=980.665, pretension_kN=98.0665, tail_breaking_load_kN=784.532)
    assert (tonf.length, tonf.breaking_load) == pytest.approx((kilo.length, kilo.breaking_load), rel=1e-12)
    assert tonf.breaking_load == pytest.approx(784532.0, rel=1e-12)
    for forces, says in (
        ({"breaking_load_kN": 900.0, "breaking_load_tonf": 90.0}, "breaking_load_tonf and breaking_load_kN are given"),
        ({"pretension_kN": 10.0}, "nothing is given; give one of breaking_load_tonf, breaking_load_kN"),
        ({"breaking_load_kN": 900.0, "pretension_kN": 0.0, "pretension_tonf": 9.0}, "pretension_tonf and pretension_"),
    ):
        with pytest.raises(StudyError, match=says):
            made(**forces)
    assert made(breaking_load_kN=900.0, pretension_kN=0.0).length == made(breaking_load_kN=900.0).length


def test_a_fender_with_friction_slides_after_a_tenth_of_its_height_and_takes_its_reaction_in_any_unit():
    table = {"name": "F", "position": [10.0, 25.5, 1.0], "family": "cone", "height": 1.5, "friction": 0.3}

    def made(**more):
        return berth_of_tables([typed(QuayFenderTable, table | more)], [], [], HULL, np.zeros(3)).fenders[0]

    for given in ({"rated_reaction": 980.665}, {"rated_reaction_kN": 980.665}, {"rated_reaction_tonf": 100.0}):
        assert made(**given).shear == pytest.approx(0.3 * 980665.0 / 0.15, rel=1e-12)
    assert made(rated_reaction=1000.0, friction=0.0).shear == 0
    assert made(rated_reaction=1000.0, shear=700.0).shear == 700e3
    with pytest.raises(ValueError, match="allowed: both at least 0, and shear above 0 if friction is"):
        made(rated_reaction=1000.0, shear=0.0)
    with pytest.raises(StudyError, match="rated_reaction_kN and rated_reaction_tonf are given"):
        made(rated_reaction_kN=1000.0, rated_reaction_tonf=100.0)


@pytest.mark.parametrize("friction, refused", [(1.5, False), (1.51, True), (20.0, True)])
def test_friction_of_a_fender_in_per_cent_is_refused(friction, refused):
    table = {"name": "F", "position": [10.0, 25.5, 1.0], "family": "cell", "height": 1.5, "friction": friction}

    def made():
        return berth_of_tables([typed(QuayFenderTable, table)], [], [], HULL, np.zeros(3)).fenders[0]

    if refused:
        with pytest.raises(StudyError, match=rf"friction is {friction:g}; allowed: at most 1\.5"):
            made()
    else:
        assert made().friction == friction


TURNS = [("incidence_deg", 0.0, 1.0), ("incidence_deg", 90.0, 1.5), ("incidence_deg", 360.0, 1.0)]
TURNS += [("direction_deg", 90.0, 0.5), ("direction_deg", -90.0, 1.5), ("direction_deg", -360.0, 0.0)]


@pytest.mark.parametrize("key, degrees, pi", TURNS)
def test_incidence_is_from_ahead_and_direction_travelled_to(key, degrees, pi):
    one = SimpleNamespace(**({"incidence_deg": None, "direction_deg": None} | {key: degrees}))
    assert direction("wind", one) == pytest.approx(pi * math.pi)


@pytest.mark.parametrize("table, says", [
    ({"direction_deg": -361.0}, "wind.direction_deg is -361; allowed: −360 to 360"),
    ({"direction_deg": 0.0, "incidence_deg": 0.0}, "wind: both are given"), ({}, "wind: neither is given"),
])  # fmt: skip
def test_a_direction_is_given_once_within_a_turn(table, says):
    with pytest.raises(StudyError, match=says.replace("(", r"\(")):
        direction("wind", SimpleNamespace(**({"incidence_deg": None, "direction_deg": None} | table)))


def test_speeds_come_in_knots_too_and_nothing_is_a_speed():
    assert speed("wind", SimpleNamespace(speed=None, speed_knots=10.0)) == pytest.approx(10 * 1852 / 3600)
    assert speed("wind", SimpleNamespace(speed=0.0, speed_knots=None)) == 0.0
    with pytest.raises(StudyError, match="speed and speed_knots are given"):
        speed("wind", SimpleNamespace(speed=1.0, speed_knots=2.0))
    with pytest.raises(StudyError, match="is -1; allowed: above 0"):
        one_of("a", SimpleNamespace(b=-1.0), {"b": 1.0})


@pytest.mark.parametrize("name, key, good", [("davenport", "surface_drag", True), ("davenport", "gust_height", False),
                                             ("npd", "gust_height", True), ("npd", "surface_drag", False),
                                             ("kaimal", "gust_intensity", True), ("hino",
                                              "gust_exponent", True)])  # fmt: skip
def test_a_law_of_gusts_has_keys_of_its_own(name, key, good):
    value = {"surface_drag": 0.002, "gust_height": 12.0, "gust_intensity": 0.1, "gust_exponent": 0.15}[key]
    table = typed(WindTable, {"speed": 30.0, "gusts": name, key: value})
    if good:
        other = gusts_of(typed(WindTable, {"speed": 30.0, "gusts": name}))
        assert gusts_of(table) is not None and gusts_of(table) != other
        return
    with pytest.raises(StudyError, match=f"wind.{key} is given for {name}; allowed"):
        gusts_of(table)


def test_davenports_gusts_have_their_variance_by_the_drag_of_the_surface():
    """σ² = 6 K U²"""
    made = gusts_of(typed(WindTable, {"speed": 30.0, "gusts": "davenport", "surface_drag": 0.002}))
    omega = np.geomspace(1e-6, 1e4, 200_001)
    assert np.trapezoid(made.density(omega), omega) == pytest.approx(6 * 0.002 * 30.0**2, rel=0.01)


LEFT_OUT = {"davenport": {"surface_drag": 0.003}, "npd": {"gust_height": 10.0},
            "hino": {"surface_drag": 0.003, "gust_height": 10.0, "gust_exponent": 1 / 7},
            "kaimal": {"gust_height": 10.0, "gust_intensity": 0.12}}  # fmt: skip


@pytest.mark.parametrize("name", LEFT_OUT)
def test_what_a_law_of_gusts_is_not_given_is_that_of_its_page(name):
    omega = np.array([0.01, 0.1, 1.0])
    made, wanted = (gusts_of(typed(WindTable, {"speed": 30.0, "gusts": name} | more)) for more in ({}, LEFT_OUT[name]))
    assert made.density(omega) == pytest.approx(wanted.density(omega), rel=1e-12)
