"""MoorDyn files without lines: rods and bodies that hang, stand, float, lean or sink by themselves."""

import numpy as np
import pytest

from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.formats.moordyn import parse_moordyn
from hakobune.mooring.formats.moordyn_loose import Still, rests_of_moordyn
from hakobune.mooring.formats.moordyn_system import still_water, system_of_moordyn

FILE = """\
--- ROD TYPES ---
TypeName Diam Mass/m Cd Ca CdEnd CaEnd
(name) (m) (kg/m) (-) (-) (-) (-)
tube {d} {mass} 1 1 1 1
--- BODIES ---
ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG* I* Volume CdA* Ca*
# - m m m deg deg deg kg m kg m3 m2 -
1 free 0 0 -3 0 0 0 {body} 0 1 2.0 0 0
--- RODS ---
ID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs Outputs
(#) (name) (-) (m) (m) (m) (m) (m) (m) (-) (-)
1 tube {rod} 5 -
--- OPTIONS ---
{depth} WtrDpth
1000 WtrDnsty
"""
AREA = np.pi / 4 * 0.2**2


def rest_of(rod, s, d=0.2, depth=40.0, body=1e3):
    file = parse_moordyn(FILE.format(d=d, mass=s * 1000 * np.pi / 4 * d**2, rod=rod, depth=depth, body=body))
    return rests_of_moordyn(file, still_water(file))


@pytest.mark.parametrize("s", [0.03, 0.4, 0.5, 0.93])
def test_a_free_rod_floats_lying_with_as_much_under_water_as_it_weighs(s):
    rod = rest_of("Free 0 0 -9 3 4 -9", s)[0]
    z = rod.ends[:, 2]
    y = np.linspace(-0.1, 0.1, 400001)[1:-1]
    half = np.sqrt(0.01 - y**2)
    wet = np.clip(-z[0] + half, 0, 2 * half)  # depth of water over its lowest point, across the section
    assert rod.state == "floats, lying" and z[0] == z[1]
    assert np.trapezoid(wet, y) == pytest.approx(s * AREA, rel=1e-5)
    assert np.allclose(rod.ends[1] - rod.ends[0], [3, 4, 0])


def test_a_disc_floats_flat_a_log_lies_and_a_die_does_neither():
    assert rest_of("Free 0 0 0 0 0 -0.02", 0.5)[0].state == "floats upright"
    assert rest_of("Free 0 0 0 0 0 -2", 0.5)[0].state == "floats, lying"
    with pytest.raises(FormatError, match="floats neither lying nor upright; allowed"):
        rest_of("Free 0 0 0 0 0 -0.18", 0.5)


@pytest.mark.parametrize(
    ("rod", "s", "state", "end"),
    [
        ("Pinned 0 0 -5 1 0 -5", 0.2, "stands on its pin", (0, 0, -4)),
        ("Pinned 0 0 -5 1 0 -5", 1.2, "hangs from its pin", (0, 0, -6)),
        ("Pinned 0 0 9 0 4 9", 0.5, "hangs from its pin", (0, 0, 5)),
        ("Pinned 0 0 -3.5 0 4 -3.5", 0.5, "stands on its pin", (0, 0, 0.5)),
        ("Pinned 0 0 -38 4 0 -38", 1.2, "leans on the bed", (np.sqrt(12), 0, -40)),
    ],
)
def test_a_pinned_rod_stands_or_hangs(rod, s, state, end):
    found = rest_of(rod, s)[0]
    given = np.array(rod.split()[1:], float).reshape(2, 3)
    assert found.state == state and np.allclose(found.ends, [given[0], end])
    assert np.linalg.norm(np.subtract(*found.ends)) == pytest.approx(np.linalg.norm(np.subtract(*given)))


@pytest.mark.parametrize("pin", [-2.0, -0.4, 0.5, 2.0])
@pytest.mark.parametrize("s", [0.3, 0.6])
def test_a_rod_that_leans_in_the_surface_has_no_moment_about_its_pin(pin, s):
    L = 4.0
    found = rest_of(f"Pinned 1 2 {pin} 1 {2 + L} {pin}", s)[0]
    assert found.state == "leans in the surface" and np.allclose(found.ends[1, 0], 1)
    t = (np.arange(400000) + 0.5) / 400000
    z = pin + t * (found.ends[1, 2] - pin)
    moment = np.mean(t * ((z < 0) - s))  # over its level length, per weight of the water in its place
    assert abs(moment) < 1e-5


def test_a_heavy_rod_lies_on_the_bed_and_a_body_sinks_or_floats():
    rod, body = rest_of("Free 0 0 -9 0 0 -12", 2.0)
    assert rod.state == "lies on the bed" and np.allclose(rod.ends, [[-1.5, 0, -39.9], [1.5, 0, -39.9]])
    assert body.state == "floats, its shape is not known" and body.ends is None
    assert rest_of("Body1 0 0 0 0 0 1", 2.0, body=1.99e3)[0].state == "sinks"


def test_without_gravity_everything_stays_and_rods_may_share_a_number():
    file = parse_moordyn(FILE.format(d=0.2, mass=9, rod="Free 0 0 7 0 1 8", depth=40, body=0))
    assert [one.state for one in rests_of_moordyn(file, Still(1000.0, 0.0, 40.0))] == ["stays, nothing moves it"] * 2
    twice = FILE.replace("--- OPTIONS", "1 tube Free 0 0 3 0 1 3 5 -\n--- OPTIONS")
    twice = parse_moordyn(twice.format(d=0.2, mass=9, rod="Free 0 0 7 0 1 8", depth=40, body=0))
    assert len(twice.rods) == 2
    with pytest.raises(FormatError, match="there are no LINES, but BODIES, RODS alone; allowed: with lines"):
        system_of_moordyn(twice)


def test_what_is_not_known_of_a_rod_is_refused_with_what_is_allowed():
    with pytest.raises(FormatError, match=r"deep, in 0\.05 m of water; allowed: clear of the bed"):
        rest_of("Free 0 0 0 0 4 0", 0.5, depth=0.05)
    with pytest.raises(FormatError, match="leans in the surface, L/d 2; allowed there: 5 or more"):
        rest_of("Pinned 0 0 -0.1 0 0.4 -0.1", 0.5)
    with pytest.raises(FormatError, match="attachment of rod 1 is 'Turbine'; allowed without lines"):
        rest_of("Turbine 0 0 0 0 4 0", 0.5)
