"""Ropes of MoorDyn files that stretch by a table, and Syrope polyester ropes at rest."""

import warnings

import numpy as np
import pytest

from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.formats.moordyn import read_moordyn
from hakobune.mooring.formats.moordyn_ropes import WorkingCurves
from hakobune.mooring.formats.moordyn_system import system_of_moordyn
from hakobune.mooring.formats.moordyn_writing import moordyn_of_system
from hakobune.mooring.lines.system.equilibrium import rest

OWC = np.column_stack([np.linspace(0, 0.06, 30), 8.3e7 * np.linspace(0, 0.06, 30) ** 1.05])
FORMS = [("linear", 1.3e8, 0.0), ("linear", 0.3, 0.0), ("quadratic", 0.25, 1.0), ("exp", 0.2, 1.5), ("exp", 0.2, 0.0)]
FILE = """\
--- LINE TYPES ---
Name Diam MassDen EA BA/-zeta EI Cd Ca CdAx CaAx
(-) (m) (kg/m) (N) (-) (-) (-) (-) (-) (-)
rope 0.2 {mass} {EA} -1 0 0 0 0 0
--- POINTS ---
ID Attachment X Y Z Mass Volume CdA Ca
- - - - - - - - -
1 Fixed 0 0 -5 0 0 0 0
2 {end}
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs
- - - - - -
1 rope 1 2 100 20
--- SYROPE IC ---
Line(s) Tmax0 Tmean0
(-) (N) (N)
1 1.4e6 4e5
--- OPTIONS ---
{depth} WtrDpth
"""


def system(folder, EA, mass=40.0, end="Fixed 101.5 0 -5 0 0 0 0", curve="EXP WCType\n0.2 k1\n1.5 k2\n", depth=400):
    table = "--- rope ---\nStrain Tension\n(-) (N)\n" + "\n".join(f"{e!r} {T!r}" for e, T in OWC.tolist())
    (folder / "owc.dat").write_text(table)
    (folder / "syrope.dat").write_text("owc.dat OWC the curve of a new rope\n" + curve)
    (folder / "line.txt").write_text(FILE.format(EA=EA, mass=mass, end=end, depth=depth))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return system_of_moordyn(read_moordyn(folder / "line.txt"), folder / "line.txt")


@pytest.mark.parametrize(("form", "k1", "k2"), FORMS)
def test_a_working_curve_leaves_the_original_at_the_largest_tension_and_lies_below_it(form, k1, k2):
    ropes = WorkingCurves(OWC, form, k1, k2)
    for largest in (3e5, 1.4e6, 3e6):
        strain, tension = ropes.after(largest).T
        assert np.all(np.diff(strain) > 0) and np.all(np.diff(tension) > 0) and tension[0] == 0
        assert np.interp(largest, tension, strain) == pytest.approx(np.interp(largest, *OWC.T[::-1]), rel=1e-14)
        new = np.interp(strain, *OWC.T)
        worked = tension < largest
        assert np.all(tension[worked] <= new[worked]) and np.allclose(tension[~worked], new[~worked], rtol=1e-14)


def test_a_rope_gives_back_less_than_it_took_up_and_never_loaded_it_is_new():
    ropes = WorkingCurves(OWC, "quadratic", 0.25, 1.0)
    assert np.array_equal(ropes.after(0.0), OWC)
    strain, tension = ropes.after(2e6).T
    up = OWC[:, 0] <= np.interp(2e6, *OWC.T[::-1])
    taken = np.trapezoid(OWC[up, 1], OWC[up, 0])
    given = np.trapezoid(tension[tension <= 2e6], strain[tension <= 2e6])
    assert 0 < given < taken


@pytest.mark.parametrize("largest", [-1.0, 1e8])
def test_a_largest_tension_the_original_curve_does_not_reach_is_refused(largest):
    with pytest.raises(ValueError, match="allowed: 0 to"):
        WorkingCurves(OWC, "linear", 0.3, 0.0).after(largest)


def test_a_taut_rope_without_weight_pulls_what_its_working_curve_says(tmp_path):
    mass = 1025 * np.pi / 4 * 0.2**2  # of the water it takes the place of
    made = system(tmp_path, "SYROPE:syrope.dat|1.5e8|23", mass)
    xi = (0.015 - 0.2 * (end := np.interp(1.4e6, *OWC.T[::-1]))) / (0.8 * end)
    exact = 1.4e6 * np.expm1(1.5 * xi) / np.expm1(1.5)
    chord = 1.4e6 * 1.5**2 * np.exp(1.5) / np.expm1(1.5) / 8 / 100**2
    assert abs(rest(made).tension[0] - exact) < chord
    beyond = system(tmp_path, "SYROPE:syrope.dat|1.5e8|23", mass, "Fixed 103 0 -5 0 0 0 0")
    assert rest(beyond).tension[0] == pytest.approx(np.interp(0.03, *OWC.T), rel=1e-9)
    new = system(tmp_path, "owc.dat", mass)
    assert rest(new).tension[0] == pytest.approx(np.interp(0.015, *OWC.T), rel=1e-9)


@pytest.mark.parametrize(("EA", "worked"), [("owc.dat", False), ("SYROPE:syrope.dat|1.5e8|23", True)])
def test_a_heavy_rope_reaches_its_end_by_the_strains_of_its_tensions(tmp_path, EA, worked):
    made = system(tmp_path, EA, 90.0, "Fixed 55 0 -90 0 0 0 0")
    weight = made.lines[0].segments[0].weight * made.lines[0].length / 100  # N/m of the new rope
    curve = WorkingCurves(OWC, "exp", 0.2, 1.5).after(1.4e6) if worked else OWC
    state = rest(made)
    H, V = state.lines.horizontal_a[0], state.lines.vertical_a[0]
    s = (np.arange(200000) + 0.5) / 2000
    down = V - weight * s
    T = np.hypot(H, down)
    stretched = (1 + np.interp(T, curve[:, 1], curve[:, 0])) / T
    reach = 100 * np.array([(H * stretched).mean(), -(down * stretched).mean()])
    assert np.allclose(reach, [55, -85], atol=1e-6)
    assert V + state.lines.vertical_b[0] == pytest.approx(100 * weight, rel=1e-9)


FAULTS = [
    ("none.dat", "EXP WCType\n0.2 k1\n1.5 k2\n", "EA of rope is 'none.dat'"),
    ("SYROPE:syrope.dat|1|1", "CUBIC WCType\n0.2 k1\n1.5 k2\n", "WCType LINEAR, QUADRATIC, EXP"),
    ("SYROPE:syrope.dat|1|1", "EXP WCType\n1.2 k1\n1.5 k2\n", "working curves begin at the strain"),
    ("SYROPE:syrope.dat|1|1", "QUADRATIC WCType\n0.2 k1\n1.5 k2\n", "a working curve falls"),
]


@pytest.mark.parametrize(("EA", "curve", "message"), FAULTS)
def test_a_faulty_table_is_named_with_what_is_allowed(tmp_path, EA, curve, message):
    with pytest.raises(FormatError, match="allowed") as fault:
        system(tmp_path, EA, curve=curve)
    assert message in str(fault.value) and "\n" not in str(fault.value)


def test_a_rope_with_a_table_is_not_written_as_if_it_had_none(tmp_path):
    with pytest.raises(FormatError, match="stretches by a table; allowed for MoorDyn"):
        moordyn_of_system(system(tmp_path, "owc.dat"))
