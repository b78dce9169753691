"""Units, rows and inputs of files as OrcaFlex and WAMIT have them: pounds, feet, limits, listings, keys left out."""

from dataclasses import replace

import numpy as np
import pytest
from exact.water_waves import wavenumber
from test_limits_of_laws import a_set

from hakobune.bem.formats import capytaine, nemoh, orcaflex, wamit, wamit_inputs
from hakobune.bem.formats.orcaflex import FORCES, LENGTHS, MASSES, Units
from hakobune.bem.formats.values import FormatError, Values
from hakobune.bem.formats.yaml_text import YamlFault, parse
from hakobune.bem.modes import Body

POUND, GRAVITY = 0.45359237, 9.80665  # kg, m/s²: the international pound and standard gravity, by definition
FOOT = 0.3048  # m


def test_units_are_those_of_the_international_yard_and_pound():
    lengths = {"m": 1.0, "km": 1000.0, "mm": 0.001, "cm": 0.01, "ft": FOOT, "in": FOOT / 12}
    assert pytest.approx(lengths) == LENGTHS
    kip = 1000 * POUND
    slug = POUND * GRAVITY / FOOT
    masses = {"te": 1000.0, "t": 1000.0, "kg": 1.0, "lb": POUND, "slug": slug}
    assert pytest.approx(masses | dict.fromkeys(("kip", "kips", "klb"), kip), rel=1e-7) == MASSES
    tonne, kips = 1000 * GRAVITY, dict.fromkeys(("kip", "kips", "klbf"), kip * GRAVITY)
    forces = {"kN": 1000.0, "N": 1.0, "MN": 1e6, "te": tonne, "tef": tonne, "kgf": GRAVITY, "lbf": POUND * GRAVITY}
    assert pytest.approx(forces | kips, rel=1e-12) == FORCES


@pytest.mark.parametrize("general, units", [
    ({}, (1.0, 1000.0, 1000.0)), ({"UnitsSystem": "SI"}, (1.0, 1000.0, 1000.0)),
    ({"UnitsSystem": "US"}, (FOOT, 1000 * POUND, 1000 * POUND * GRAVITY)),
    ({"UnitsSystem": "User"}, (1.0, 1000.0, 1000.0)),
    ({"UnitsSystem": "User", "LengthUnits": "ft", "MassUnits": "kg", "ForceUnits": False}, (FOOT, 1.0, 1.0)),
    ({"UnitsSystem": "User", "ForceUnits": "MN"}, (1.0, 1000.0, 1e6)),
])  # fmt: skip
def test_units_of_a_model_are_those_of_its_system(general, units):
    assert orcaflex._units(general, "a.yml") == pytest.approx(units)


MATRIX = np.arange(1.0, 37).reshape(6, 6)
ARMS = np.array([0, 0, 0, 1, 1, 1])


def rows(*ats):
    """Matrices of row n are n times the first"""
    return [
        {"AMDPeriodOrFrequency": at, orcaflex.MASS_COLUMNS: ((n + 1) * MATRIX).tolist(),
         orcaflex.DAMPING_COLUMNS: (-(n + 1) * MATRIX).tolist()}
        for n, at in enumerate(ats)
    ]  # fmt: skip


def test_rows_of_added_mass_come_in_any_order_with_the_limits_among_them():
    """kg, kg m, kg m² of kilopounds and feet; damping over a second: force over length, times arms"""
    draught = {"FrequencyDependentAddedMassAndDamping": rows(0.9, "Infinity", 0.5, 0.0)}
    found = orcaflex._read_matrices(draught, lambda x: x, Units(2.0, 3.0, 5.0))
    arms = 2.0 ** (ARMS + ARMS[:, None])
    assert found["omega"].tolist() == [0.5, 0.9]
    assert found["added_mass"] == pytest.approx(np.array([3 * MATRIX, MATRIX]) * 3 * arms)
    assert found["radiation_damping"] == pytest.approx(-np.array([3 * MATRIX, MATRIX]) * 2.5 * arms)
    assert found["added_mass_infinity"] == pytest.approx(2 * MATRIX * 3 * arms)
    assert found["added_mass_zero"] == pytest.approx(4 * MATRIX * 3 * arms)
    bare = orcaflex._read_matrices({"FrequencyDependentAddedMassAndDamping": rows(0.9)}, lambda x: x, Units(1, 1, 1))
    assert set(bare) == {"omega", "added_mass", "radiation_damping"}


def test_periods_of_a_model_are_frequencies_with_infinity_for_zero():
    period, hertz = orcaflex.TO_OMEGA["period (s)"], orcaflex.TO_OMEGA["frequency (Hz)"]
    assert period([4.0, 0.0]).tolist() == [np.pi / 2, np.inf] and hertz(0.25) == pytest.approx(np.pi / 2)
    assert orcaflex.TO_OMEGA["frequency (rad/s)"](0.7) == 0.7


@pytest.mark.parametrize("buoyancy", [{}, {"CentreOfBuoyancy": None}, {"CentreOfBuoyancy": [None, None, None]},
                                      {"CentreOfBuoyancy": [1.0, None, 2.0]}])  # fmt: skip
def test_a_body_without_a_centre_of_buoyancy_or_a_volume_has_none(buoyancy):
    found = orcaflex._read_body(buoyancy | {"DisplacedVolume": None}, np.zeros(3), 10.0, Units(2.0, 3.0, 5.0))
    assert found == {}


def test_a_body_has_its_mass_and_stiffness_about_the_reference_origin():
    """M = m, m × arm, I + m (r² − r rᵀ); C = K − m g (z_G − z_R) in roll and pitch"""
    tensor, K = np.diag([4.0, 5, 6]), np.array([[7.0, 1, 2], [1, 8, 3], [2, 3, 9]])
    draught = {"Mass": 11.0, orcaflex.INERTIA_COLUMNS: tensor.tolist(), "CentreOfGravity": [1.0, 2, 3],
               "CentreOfMass": [1.5, -0.5, 2], orcaflex.STIFFNESS_COLUMNS: K.tolist(), "DisplacedVolume": 13.0,
               "CentreOfBuoyancy": [0.5, 0, -1]}  # fmt: skip
    about = np.array([1.0, 3.0, -2.0])
    found = orcaflex._read_body(draught, about, 10.0, Units(2.0, 3.0, 5.0))
    center, mass = np.array([3.0, -1, 4]), 33.0
    r = center - about
    assert found["mass"] == mass and found["center_of_mass"] == pytest.approx(center)
    assert found["displaced_volume"] == 8 * 13.0 and found["center_of_buoyancy"] == pytest.approx([1.0, 0, -2])
    M = found["inertia_matrix"]
    for velocity in np.eye(6):
        v, w = velocity[:3], velocity[3:]
        of_center = v + np.cross(w, r)
        momentum = mass * of_center
        spin = 3 * 4.0 * (tensor @ w) + np.cross(r, momentum)
        assert M @ velocity == pytest.approx(np.concatenate([momentum, spin]))
    C = np.zeros((6, 6))
    C[2:5, 2:5] = 2.5 * K * 2.0 ** (ARMS[2:5] + ARMS[2:5, None])
    C[3, 3] -= mass * 10 * r[2]
    C[4, 4] -= mass * 10 * r[2]
    assert found["hydrostatic_stiffness"] == pytest.approx(C)
    for key in ("Mass", orcaflex.INERTIA_COLUMNS):
        less = {name: value for name, value in draught.items() if name != key}
        bare = orcaflex._read_body(less, about, 10.0, Units(2.0, 3.0, 5.0))
        assert not {"mass", "inertia_matrix", "center_of_mass"} & set(bare)
        if key == "Mass":
            assert bare["hydrostatic_stiffness"][3, 3] == pytest.approx(2.5 * 8 * 4)


@pytest.mark.parametrize("module", [orcaflex, wamit, capytaine, nemoh])
@pytest.mark.parametrize("name", ["added_mass", "radiation_damping", "excitation_force"])
def test_files_are_written_of_added_mass_and_damping_and_orcaflex_has_forces_too(module, name, tmp_path):
    shapes = {"added_mass": (2, 6, 6), "radiation_damping": (2, 6, 6), "excitation_force": (2, 1, 6)}
    quantities = {one: np.zeros(shape) for one, shape in shapes.items() if one != name}
    made = Values(np.array([0.5, 0.9]), np.zeros(1), 20.0, 1025.0, 9.81, quantities)
    if name == "excitation_force" and module is not orcaflex:
        return
    with pytest.raises(FormatError, match=rf"^{name} is not in the database; give it by --only"):
        module.write(made, tmp_path / "one")
    assert not list(tmp_path.iterdir())


def test_a_vessel_is_written_in_tonnes_and_kilonewtons_about_the_rotation_centre(tmp_path):
    """Inertia about the centre of mass, stiffness without weight, lags in degrees, motions in degrees per metre"""
    rng, about, center, mass = np.random.default_rng(8), np.array([1.0, 3.0, -2.0]), np.array([2.0, 5.0, 1.0]), 7e6
    own, r = np.diag([4e8, 5e8, 6e8]), center - about
    inertia = np.zeros((6, 6))
    inertia[3:, 3:] = own + mass * (r @ r * np.eye(3) - np.outer(r, r))
    C = np.zeros((6, 6))
    C[2:5, 2:5] = [[7e6, 1e6, 2e6], [1e6, 8e6, 3e6], [2e6, 3e6, 9e6]]
    A, B = rng.normal(size=(2, 2, 6, 6)) * 1e6
    X, rao = (rng.normal(size=(2, 2, 6)) + 1j * rng.normal(size=(2, 2, 6)) for _ in range(2))
    made = Values(
        np.array([0.5, 0.9]), np.array([0.0, np.pi / 2]), np.inf, 1025.0, 9.81,
        {"added_mass": A, "radiation_damping": B, "excitation_force": 1e5 * X, "rao": rao, "added_mass_infinity": A[0]},
        {"mass": mass, "inertia_matrix": inertia, "displaced_volume": 6800.0, "center_of_mass": center,
         "center_of_buoyancy": np.array([1.0, 2.0, -3.0]), "hydrostatic_stiffness": C}, about, name="one",
    )  # fmt: skip
    (path,) = orcaflex.write(made, tmp_path / "one.yml")
    model = parse(path.read_text())
    draught = model["VesselTypes"][0]["Draughts"][0]
    assert model["Environment"] == {"Density": 1.025, "WaterDepth": 1e5} and draught["Mass"] == 7e3
    assert np.array(draught[orcaflex.INERTIA_COLUMNS]) == pytest.approx(own / 1e3)
    assert draught["CentreOfMass"] == center.tolist() and draught["CentreOfBuoyancy"] == [1.0, 2.0, -3.0]
    assert draught["DisplacedVolume"] == 6800.0
    weight = mass * 9.81 * 3.0  # G is 3 m above the reference
    assert np.array(draught[orcaflex.STIFFNESS_COLUMNS]) == pytest.approx(
        (C[2:5, 2:5] + np.diag([0.0, weight, weight])) / 1e3
    )
    for key in ("ReferenceOrigin", "ReferenceOriginDatumPosition"):
        assert draught[key] == about.tolist()
    turns = np.array([1.0] * 3 + [180 / np.pi] * 3)
    for group, whole in (("LoadRAOs", 1e2 * X), ("DisplacementRAOs", rao * turns)):
        assert draught[group]["RAOOrigin"] == about.tolist() and draught[group]["PhaseOrigin"] == [0, 0, 0]
        assert [one["RAODirection"] for one in draught[group]["RAOs"]] == pytest.approx([0.0, 90.0])
        for m, one in enumerate(draught[group]["RAOs"]):
            table = np.array(one[orcaflex.RAO_COLUMNS], float)
            assert table[:, 0].tolist() == [0.5, 0.9]
            assert table[:, 1::2] * np.exp(1j * np.radians(table[:, 2::2])) == pytest.approx(whole[:, m])
    rows = draught["FrequencyDependentAddedMassAndDamping"]
    assert [row["AMDPeriodOrFrequency"] for row in rows] == ["Infinity", 0.5, 0.9]
    for row, mass_of, drain in zip(rows, (A[0], *A), (0 * B[0], *B), strict=True):
        assert np.array(row[orcaflex.MASS_COLUMNS]) == pytest.approx((mass_of + mass_of.T) / 2e3)
        assert np.array(row[orcaflex.DAMPING_COLUMNS]) == pytest.approx((drain + drain.T) / 2e3)


@pytest.mark.parametrize("said, lag", [
    ({}, lambda p: np.radians(p)), ({"RAOPhaseConvention": "leads"}, lambda p: -np.radians(p)),
    ({"RAOPhaseUnitsConvention": "radians"}, lambda p: p),
    ({"RAOPhaseRelativeToConvention": "trough"}, lambda p: np.radians(p) + np.pi),
    ({"RAOPhaseRelativeToConvention": "zero down-crossing"}, lambda p: np.radians(p) + np.pi / 2),
    ({"RAOPhaseRelativeToConvention": "zero up-crossing"}, lambda p: np.radians(p) + 1.5 * np.pi),
])  # fmt: skip
def test_responses_lag_the_crest_by_their_phase(said, lag):
    """Rows of frequency, then amplitude and phase of each motion; headings in degrees, in any order"""
    vessel = {"RAOPhaseUnitsConvention": "degrees", "RAOPhaseConvention": "lags",
              "RAOPhaseRelativeToConvention": "crest"} | said  # fmt: skip
    group, X = {"RAOs": []}, {}
    for heading in (90.0, 0.0):
        table = []
        for omega in (0.8, 0.4):
            amplitude, phase = np.arange(1.0, 7) * omega + heading, np.arange(6.0) * 0.3 + omega
            table.append([omega, *np.column_stack([amplitude, phase]).ravel()])
            X[omega, heading] = amplitude * np.exp(1j * lag(phase))
        group["RAOs"].append({"RAODirection": heading, orcaflex.RAO_COLUMNS: table})
    omega, headings, found = orcaflex._read_responses(group, vessel, "a.yml", lambda x: x)
    assert omega.tolist() == [0.4, 0.8] and headings == pytest.approx([0.0, np.pi / 2])
    for i, w in enumerate((0.4, 0.8)):
        for j, b in enumerate((0.0, 90.0)):
            assert found[i, j] == pytest.approx(X[w, b])


def test_responses_are_in_force_over_length_or_in_degrees_and_metres():
    turns = np.array([1, 1, 1, 2, 2, 2])
    assert orcaflex._response_unit("LoadRAOs", {}, Units(2.0, 3.0, 5.0)) == pytest.approx(2.5 * turns)
    for said, turn in (("degrees", np.pi / 180), ("radians", 1.0)):
        found = orcaflex._response_unit("DisplacementRAOs", {"RAOResponseUnits": said}, Units(2.0, 3.0, 5.0))
        assert found == pytest.approx([1.0] * 3 + [turn / 2] * 3)


def test_a_crest_at_another_point_is_told_by_its_phase_at_the_origin():
    """exp(ik·P); where PhaseOrigin is left out it is RAOOrigin"""
    group = {"PhaseOrigin": [None, 3.0, None], "RAOOrigin": [2.0, 5.0, 7.0]}
    k, headings = np.array([0.1, 0.4]), np.array([0.3, 2.0])
    expected = [[np.exp(1j * one * (2 * np.cos(b) + 3 * np.sin(b))) for b in headings] for one in k]
    assert orcaflex._crest(group, k, headings)[..., 0] == pytest.approx(np.array(expected))


def test_what_is_written_is_told_about_the_centre_of_mass_and_without_the_weight():
    """I = I_R − m (r² − r rᵀ), K = C + m g (z_G − z_R)"""
    mass, r = 3.0, np.array([1.0, 2, -0.5])
    own = np.diag([4.0, 5, 6])
    about_R = np.zeros((6, 6))
    about_R[3:, 3:] = own + mass * (r @ r * np.eye(3) - np.outer(r, r))
    values = a_set(added_mass=np.zeros((1, 6, 6)), body={"inertia_matrix": about_R, "mass": mass, "center_of_mass": r})
    assert orcaflex._about_center(values)[3:, 3:] == pytest.approx(own)
    weight = orcaflex._weight(values)
    assert weight[3, 3] == weight[4, 4] == pytest.approx(mass * 10.0 * -0.5) and np.count_nonzero(weight) == 2
    assert not orcaflex._weight(a_set(added_mass=np.zeros((1, 6, 6)), body={"mass": 3.0})).any()


def test_matrices_are_written_symmetric_in_tonnes_with_the_limit_first():
    A, B = np.array([1e3 * MATRIX, 2e3 * MATRIX]), np.array([3e3 * MATRIX, 4e3 * MATRIX])
    infinity = 5e3 * MATRIX
    values = a_set(omega=(0.5, 0.9), added_mass=A, radiation_damping=B, added_mass_infinity=infinity)
    lines = list(orcaflex._matrices(values))
    assert [line for line in lines if line.startswith("- AMD")] == [
        "- AMDPeriodOrFrequency: Infinity", "- AMDPeriodOrFrequency: 0.5", "- AMDPeriodOrFrequency: 0.9",
    ]  # fmt: skip
    tables = np.array([[float(x) for x in line.strip(" -[]").split(",")] for line in lines if "[" in line])
    even = 0.5 * (MATRIX + MATRIX.T)
    assert tables.reshape(3, 2, 6, 6) == pytest.approx(
        np.array([[5 * even, 0 * even], [1 * even, 3 * even], [2 * even, 4 * even]])
    )
    values.quantities["added_mass_infinity"][2, 2] = np.inf
    assert "Infinity" not in " ".join(orcaflex._matrices(values))


def test_a_listing_of_wamit_tells_its_length_gravity_depth_and_points(tmp_path):
    """NAME.out before its first period; a length and a point that are given come first"""
    place = tmp_path / "box.out"
    lines = ["Gravity:     9.80000        Length scale:   2.5", "Water depth:   30.0   Water density: 1.0",
             "N=  1   one.gdf", "XBODY = 1.0 2.0 -3.0 0.0", "N=  2   two.gdf", "XBODY = 4.0 5.0 6.0 0.0"]  # fmt: skip
    found = wamit_inputs.listed_inputs(place, lines, {"body": 2})
    assert (found.length, found.wave_length, found.gravity, found.depth) == (2.5, 2.5, 9.8, 30.0)
    assert (found.about, found.bodies, found.told, found.hull) == ((4.0, 5.0, 6.0), 2, True, "")
    (tmp_path / "two.gdf").write_text("")
    given = {"body": 2, "length_unit": 7.0, "rotation_center": (0, 0, 1), "water_depth": 11.0}
    found = wamit_inputs.listed_inputs(place, lines, given)
    assert (found.length, found.about, found.depth, found.hull) == (7.0, (0, 0, 1), 11.0, "two.gdf")
    assert found.said == ("--depth 11 m, and not the water depth 30 m of box.out,",)
    assert wamit_inputs.listed_inputs(place, lines, {"body": 2, "water_depth": 30.0}).said == ()
    bare = wamit_inputs.listed_inputs(place, ["Gravity:  9.7", "Water depth: infinite"], {"body": 1})
    assert (bare.length, bare.gravity, bare.depth, bare.about, bare.bodies) == (1.0, 9.7, np.inf, (0.0, 0.0, 0.0), 1)
    none = wamit_inputs.listed_inputs(place, ["nothing"], {"body": 1, "gravity": 9.9})
    assert (none.gravity, none.length, none.depth) == (9.9, 1.0, np.inf)
    assert wamit_inputs.listed_inputs(place, ["nothing"], {"body": 1}).gravity == 9.80665
    turned = [line.replace("6.0 0.0", "6.0 30.0") for line in lines]
    assert wamit_inputs.listed_inputs(place, turned, {"body": 1}).about == (1.0, 2.0, -3.0)
    with pytest.raises(FormatError, match="PHIBODY turns the body by 30°; allowed: 0"):
        wamit_inputs.listed_inputs(place, turned, {"body": 2})


@pytest.mark.parametrize("off, kind", [(1.9e-3, "deep wavenumber"), (2.1e-3, "period")])
@pytest.mark.parametrize("number", [0, 1, 2])
def test_the_kind_of_the_first_column_is_that_which_gives_the_periods_of_the_listing(tmp_path, off, kind, number):
    """Each frequency within 2e-3; here k = ω²/g times a length of 2 m"""
    omega = np.array([0.5, 0.8, 1.3])
    (tmp_path / "a.out").write_text("".join(f"Wave period (sec) = {2 * np.pi / w:.9f}\n" for w in omega))
    listed = omega * np.where(np.arange(3) == number, 1 + off, 1.0)
    numbers = [2 * w**2 / 9.81 for w in listed] + [0.0]
    rows = [f"{k:.9e} {i} {i} 1.0 2.0" for k in numbers[:3] for i in (1, 2)] + ["-1 1 1 1.0", "0.0 1 1 2.0"]
    (tmp_path / "a.1").write_text("\n".join(rows) + "\n")
    given = wamit_inputs.Inputs(wave_length=2.0, depth=np.inf, gravity=9.81)
    assert wamit_inputs._kind_listed(tmp_path / "a.1", given) == kind
    (tmp_path / "a.1").write_text("\n".join(rows[:4]) + "\n")  # one frequency less
    assert wamit_inputs._kind_listed(tmp_path / "a.1", given) == "period"
    (tmp_path / "a.1").write_text("")
    assert wamit_inputs._kind_listed(tmp_path / "a.1", given) == "period"


@pytest.mark.parametrize("column", ["period", "frequency", "wavenumber"])
def test_periods_frequencies_and_wavenumbers_of_finite_depth_are_told_apart(tmp_path, column):
    omega, depth = np.array([0.5, 0.8, 1.3]), 12.0
    k = np.array([wavenumber(w, depth, 9.81) for w in omega])
    first = {"period": 2 * np.pi / omega, "frequency": omega, "wavenumber": k}[column]
    (tmp_path / "a.out").write_text("".join(f"Wave period = {2 * np.pi / w:.9f}\n" for w in omega))
    (tmp_path / "a.1").write_text("".join(f"{x:.9e} 1 1 1.0 2.0\n" for x in first))
    given = wamit_inputs.Inputs(depth=depth, gravity=9.81)
    assert wamit_inputs._kind_listed(tmp_path / "a.1", given) == column


def test_the_input_of_several_bodies_for_wamit_has_periods_headings_points_and_modes():
    """NAME.pot, section 4 of the manual; 0 for deep water; the modes of a fixed body are off"""
    bodies = (Body("one", (1.0, 2.0, -3.0)), Body("two", (4.5, 0.0, 0.0), fixed=True))
    values = replace(a_set(omega=(0.5, 2.0), headings=(0.0, 90.0), depth=12.5), bodies=bodies)
    text = wamit_inputs.pot_of(values, ["one.gdf", "two.gdf"])
    assert text.endswith("IMODE\n")
    assert text.splitlines()[1:] == [
        "12.5  HBOT", "1  1  IRAD IDIFF", "2  NPER", "12.5663706", "3.14159265", "2  NBETA", "0", "90", "2  NBODY",
        "one.gdf", "1  2  -3  0.  XBODY", "1  1  1  1  1  1  IMODE",
        "two.gdf", "4.5  0  0  0.  XBODY", "0  0  0  0  0  0  IMODE",
    ]  # fmt: skip
    assert wamit_inputs.pot_of(replace(values, water_depth=np.inf), ["a", "b"]).splitlines()[1] == "0  HBOT"


def test_a_model_without_its_general_section_is_in_tonnes_kilonewtons_and_metres(tmp_path):
    both = {name: np.array([MATRIX, MATRIX]) for name in ("added_mass", "radiation_damping")}
    values = a_set(omega=(0.5, 0.9), excitation_force=np.ones((2, 1, 6), complex), **both)
    (written,) = orcaflex.write(values, tmp_path / "a.yml")
    whole = orcaflex.read(written, {"gravity": 10.0})
    text = written.read_text()
    assert "General:\n  UnitsSystem: SI\n" in text
    for less in ("", "General:\n", "General: ~\n"):
        written.write_text(text.replace("General:\n  UnitsSystem: SI\n", less))
        found = orcaflex.read(written, {"gravity": 10.0})
        assert np.array_equal(found.get("added_mass"), whole.get("added_mass")) and found.density == whole.density


@pytest.mark.parametrize("text, line, words", [
    ("a: 1\nb: [1, 2\nc: 3\n", 3, "while parsing a flow sequence"), ("a: 1\n\tb: 2\n", 2, ""),
    ("a: &x 1\nb: *y\n", 2, "found undefined alias"), ("a: 1\na: 2\n", 2, "found duplicate key"),
])  # fmt: skip
def test_what_is_no_yaml_is_told_with_its_line(text, line, words):
    with pytest.raises(YamlFault) as fault:
        parse(text)
    assert fault.value.line == line and words in str(fault.value) and "\n" not in str(fault.value)


def test_yaml_nested_too_deep_has_no_line(monkeypatch):
    def load(self, text):
        raise RecursionError

    monkeypatch.setattr("ruamel.yaml.YAML.load", load)
    with pytest.raises(YamlFault, match="lists and tables are nested too deep") as fault:
        parse("[")
    assert fault.value.line is None
