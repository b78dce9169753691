"""What files of other programs may say: a sound one is read, and one that goes beyond a limit at one place is refused.

They are of one body at two frequencies, made by hand or as `write` makes them.
"""

import json
from dataclasses import replace

import h5py
import numpy as np
import pytest
from ruamel.yaml import YAML

from hakobune.bem.formats import aqwa, bemio, capytaine, diodore, hams, hydrostar, nemoh, orcaflex, wamit, wamit_pairs
from hakobune.bem.formats.values import FormatError, Values, body_of

RHO, G = 1025.0, 9.81
KNOWN = {"water_depth": 20.0, "density": RHO, "gravity": G}
SIX = "1.0 2.0 3.0 4.0 5.0 6.0"


def one_body(**more):
    A = np.stack([np.diag([1.0, 2, 3, 4, 5, 6]) * n for n in (1e3, 2e3)])
    quantities = {"added_mass": A, "radiation_damping": A / 10, "excitation_force": np.ones((2, 2, 6)) * (1 + 2j)}
    body = {"center_of_mass": np.zeros(3), "center_of_buoyancy": np.zeros(3), "displaced_volume": 1.0,
            "hydrostatic_stiffness": np.eye(6), "mass": RHO, "inertia_matrix": RHO * np.eye(6)}  # fmt: skip
    return Values(np.array([1.0, 2.0]), np.radians([0.0, 90.0]), 20.0, RHO, G, quantities | more, body, name="a")


def ah1(gravity=9.81, rest="", cog="COG\n 1 0 0 -1.0\n", coefficients=("ADDEDMASS", "DAMPING")):
    rows = "".join(f"{name}\n" + "".join(f" 1 1 {n}{' 1.0' * 36}\n" for n in (1, 2)) for name in coefficients)
    return f" 1 1 2 0.0\n 1.0 2.0\nGENERAL\n 20.0 1025.0 {gravity}\n{cog}{rows}{rest}"


def listing(gravity=9.81, water="WATER DEPTH", center="THE CENTRE OF GRAVITY AT ( 0.0, 0.0, -1.0)", sides=aqwa.SIDES):
    table = "\n".join(f"  {side} {SIX}" for side in sides)
    return (f" {water} = 70.0\n DENSITY OF WATER = 1025.0\n ACCELERATION DUE TO GRAVITY = {gravity}\n"
            f" FOR STRUCTURE 1\n {center}\n WAVE FREQUENCY = 0.1\n"
            f" ADDED MASS\n{table}\n DAMPING\n{table}\n")  # fmt: skip


def hdb(speed="0.0", bodies=1, first="ADDED_MASS_LINE_1", row=SIX):
    text = f"[FORWARD_SPEED] {speed}\n[STRUCTURES_NUMBER] {bodies}\n[{first}]\n 2.0 {row}\n 4.0 {SIX}\n"
    names = [f"ADDED_MASS_LINE_{i}" for i in range(2, 7)] + [f"DAMPING_TERM_{i}" for i in range(1, 7)]
    return text + "".join(f"[{name}]\n 2.0 {SIX}\n 4.0 {SIX}\n" for name in names)


def rao(kind="ADDED-MASS", mode="11", speed="0.0", rows=" 1.0 5.0 0.0\n 2.0 5.0 0.0\n", heading="#HEADING 0.0\n"):
    return (f"# Water density (rho) : 1025.0\n# Gravity acceleration : 9.81\n# Waterdepth : 20.0\n"
            f"# Ref.pt incident wave : (0.0 0.0)\n# Forward speed : {speed}\n# Reference point of body 1 : (0 0 0)\n"
            f"#RAOTYPE : {kind}\n#COMPONENT : {mode}\n{heading}{rows}")  # fmt: skip


def hydrostar_folder(folder, damping="WAVE-DAMPING", **more):
    (folder / "A.rao").write_text(rao(**more))
    (folder / "B.rao").write_text(rao(damping, rows=" 1.0 5.0 0.0\n 2.0 5.0 0.0\n"))
    return hydrostar.read(folder)


def out(period="Wave period (sec) = 5.0", mass="ADDED-MASS AND DAMPING COEFFICIENTS", turned=0.0):
    return (f"   WAMIT  Version 7\n Gravity: 9.81  Length scale: 1.0\n Water depth: 30.0\n"
            f" XBODY = 0.0 YBODY = 0.0 ZBODY = 0.0 PHIBODY = {turned}\n\n {period}\n {mass}\n"
            f"     3   3   2.0   0.1\n")  # fmt: skip


def in_file(name, read):
    """A reader of the text of one file"""

    def made(folder, text):
        (folder / name).write_text(text)
        return read(folder / name, KNOWN)

    return made


def edited(module, place, name):
    """A reader of what `write` makes, with texts replaced in one of its files"""

    def made(folder, changes):
        module.write(one_body(), folder / place)
        path = folder / name
        text = path.read_text()
        for old, new in dict(changes).items():
            assert old in text, old
            text = text.replace(old, new)
        path.write_text(text)
        return module.read(folder / place, KNOWN)

    return made


def of_wamit(folder, files):
    """Files of WAMIT beside those of one body, {suffix: text or None for what is written}"""
    wamit.write(one_body(), folder / "a")
    for suffix, text in files.items():
        (folder / f"a{suffix}").write_text(text)
    return wamit.read(folder / "a.1", KNOWN)


def of_wamit_alone(folder, files):
    """The same without depth and length given, and forces of one body left out"""
    wamit.write(one_body(), folder / "a")
    for suffix, text in files.items():
        (folder / f"a{suffix}").write_text(text)
    return wamit.read(folder / "a.1", KNOWN | {"water_depth": None})


def hdf(module, name):
    def made(folder, change):
        module.write(one_body(), folder / name)
        with h5py.File(folder / name, "a") as file:
            change(file)
        return module.read(folder / name)

    return made


def pairs(folder, rows):
    (folder / "a.12d").write_text(rows)
    return wamit_pairs.read_pairs(folder / "a.1", RHO * G)


def of_pairs(*omegas):
    """Rows of the pairs of each frequency with itself and with those above it"""
    return "\n".join(f"{2 * np.pi / a:.9f} {2 * np.pi / b:.9f} 0.0 0.0 {i} 1.0 0.0 1.0 0.0"
                     for a in omegas for b in omegas if a >= b for i in range(1, 7))  # fmt: skip


def replaced(name, data):
    def change(file):
        del file[name]
        file[name] = data

    return change


def nothing(file):
    pass


FORMAT_1 = " 6.28 1 1 1.0 0.5\n 3.14 1 1 1.0 0.5\n"
GDF = "hull\n{0} 9.81\n0 0\n0\n"
POT = "h\n20.0\n1 1\n-1\n0.6 0.4\n1\n0.0\n1\none.gdf\n{0}\n"

LIMITS = {
    "gravity of AQWA": (in_file("a.AH1", aqwa.read), ah1(9.4), ah1(9.3),
        "a.AH1 has gravity 9.3; allowed: a model in metres, kilograms and newtons"),
    "gravity above": (in_file("a.AH1", aqwa.read), ah1(10.29), ah1(10.31), "has gravity 10.31"),
    "sections of AQWA": (in_file("a.AH1", aqwa.read), ah1(), " 1 1 2 0.0\n 1.0 2.0\n",
        "has no section; allowed: GENERAL, COG, ADDEDMASS, DAMPING, FORCERAO"),
    "a section that is missing": (in_file("a.AH1", aqwa.read), ah1(), ah1(coefficients=("ADDEDMASS",)),
        "is no file of AQWA's hydrodynamic coefficients, or it ends too soon: 'DAMPING'"),
    "bodies of AQWA": (in_file("a.AH1", aqwa.read), ah1(), ah1(cog="COG\n 1 0 0 -1\n 2 0 0 -1\n"),
        "a.AH1 has 2 bodies; give one of them by --body, 1 to 2"),
    "water of a listing": (in_file("a.LIS", aqwa.read), listing(), listing(water="DEPTH"),
        r"a.LIS does not contain 'WATER\\s+DEPTH'; allowed: the listing of a run of AQWA-LINE"),
    "centre of a listing": (in_file("a.LIS", aqwa.read), listing(center="C.O.G GX 0.0 0.0 -1.0"), listing(center=""),
        "a.LIS does not give the centre of gravity of structure 1"),
    "rows of a listing": (in_file("a.LIS", aqwa.read), listing(), listing(sides=aqwa.SIDES[:5]),
        "a.LIS has no added mass and damping of structure 1"),
    "speed of Diodore": (in_file("a.hdb", diodore.read), hdb(), hdb("0.5"), "a.hdb is for a body with forward speed; "
        "allowed: speed 0"),
    "bodies of Diodore": (in_file("a.hdb", diodore.read), hdb(), hdb(bodies=2), "a.hdb has 2 bodies; give one of them"),
    "sections of Diodore": (in_file("a.hdb", diodore.read), hdb(), hdb(first="ADDED_MASS"),
        "has no [ADDED_MASS_LINE_1]; allowed: a data base with hydrodynamic parameters"),
    "numbers of Diodore": (in_file("a.hdb", diodore.read), hdb(row="1.0D0 2 3 4 5 6"), hdb(row="x 2 3 4 5 6"),
        "[ADDED_MASS_LINE_1] is not a full table of numbers"),
    "rows of Diodore": (in_file("a.hdb", diodore.read), hdb(), hdb(row="2 3 4 5 6"),
        "[ADDED_MASS_LINE_1] is not a full table of numbers"),
    "damping of HydroStar": (hydrostar_folder, {"damping": "DAMPING"}, {"damping": "LOAD"},
        "has no files of added mass and damping; allowed: AddedMass_11.rao, WaveDamping_11.rao"),
    "speed of HydroStar": (hydrostar_folder, {}, {"speed": "0.5"}, "is for a forward speed of 0.5 m/s; allowed: 0"),
    "frequencies of HydroStar": (hydrostar_folder, {}, {"rows": " 1.0 5.0 0.0\n 2.0 5.0 0.0\n 3.0 5.0 0.0\n"},
        "has tables with different frequencies or headings; allowed: tables of one run"),
    "rows of HydroStar": (hydrostar_folder, {}, {"rows": ""}, "A.rao has a header but no rows; allowed: a row for "
        "each"),
    "head of HydroStar": (hydrostar_folder, {}, {"heading": ""}, "A.rao does not have the header and rows that"),
    "numbers of HydroStar": (hydrostar_folder, {}, {"rows": " 1.0 x 0.0\n"}, "does not have the header and"),
    "scale of BEMIO": (hdf(bemio, "a.h5"), nothing, replaced("simulation_parameters/scaled", [[1.0]]),
        "is scaled; allowed: numbers normalised as WAMIT does, scaled = 0"),
    "groups of BEMIO": (hdf(bemio, "a.h5"), nothing, lambda file: file.move("simulation_parameters", "x"),
        "a.h5 is no file of BEMIO"),
    "groups of Capytaine": (hdf(capytaine, "a.nc"), nothing, lambda file: file.move("rho", "x"),
        "a.nc is no file of Capytaine"),
    "axes of Capytaine": (hdf(capytaine, "a.nc"), nothing, replaced("added_mass", np.ones((2, 6, 6))),
        "a.nc: /added_mass has an axis without a name"),
    "modes of Capytaine": (hdf(capytaine, "a.nc"), nothing, replaced("radiating_dof", [b"Bending"] + [b"Surge"] * 5),
        "has the modes Bending, Surge, Surge, Surge, Surge, Surge; allowed: Surge, Sway, Heave, Roll, Pitch, Yaw"),
    "words of Nemoh.cal": (edited(nemoh, "n", "n/Nemoh.cal"), {}, {"0. 0.\t! XEFF": "0.\t! XEFF"},
        "expected 2 number(s), found"),
    "motions of Nemoh": (edited(nemoh, "n", "n/Nemoh.cal"), {"1 0. 1. 0.": "1 0. 2. 0."}, {"1 0. 1. 0.": "1 0. -1. 0."},
        "has a motion or force of kind 1 along [0.0, -1.0, 0.0]; allowed: surge to yaw, along and about the axes"),
    "kinds of Nemoh": (edited(nemoh, "n", "n/Nemoh.cal"), {}, {"1 0. 1. 0.": "3 0. 1. 0."}, "of kind 3 along"),
    "axes of Nemoh": (edited(nemoh, "n", "n/Nemoh.cal"), {"2 0. 1. 0.": "2 0. 1. 1e-10"},
        {"2 0. 1. 0.": "2 0. 1. 1e-8"}, "has a motion or force of kind 2 along [0.0, 1.0, 1e-08]"),
    "headings of Nemoh": (edited(nemoh, "n", "n/Nemoh.cal"), {}, {"2 0 90": "3 0 90"},
        "ExcitationForce.tec has 2 zones of 13 numbers a line; Nemoh.cal asks for 3 zones of 13 numbers"),
    "rows of Nemoh": (edited(nemoh, "n", "n/Results/RadiationCoefficients.tec"), {}, {"E+03 ": "E+03 x "},
        "RadiationCoefficients.tec"),
    "numbers of Nemoh": (edited(nemoh, "n", "n/Results/ExcitationForce.tec"), {" 1.000000000E+00 ": " 1.0000001E+00 "},
        {" 1.000000000E+00 ": " 1.1 "},
        "the frequencies of RadiationCoefficients.tec; allowed: the same frequencies; it has no 1 rad/s"),
    "kind of frequency of HAMS": (edited(hams, "h", "h/Input/ControlFile.in"), {}, {"Output_frequency_type   4":
        "Output_frequency_type 6"}, "Output_frequency_type is 6; allowed: 1 (deep wavenumber), 2 (wavenumber), "
        "3 (frequency), 4 (period), 5 (wavelength)"),
    "depth of HAMS": (edited(hams, "h", "h/Input/ControlFile.in"), {}, {"Waterdepth": "Depth"},
        "has no number for Waterdepth; give Waterdepth and its value on one line"),
    "bodies of HAMS": (edited(hams, "h", "h/Input/ControlFile.in"), {"Reference_body_length": "Number_of_bodies 1\n"
        "Reference_body_length"}, {"Reference_body_length": "Number_of_bodies 2\nReference_body_length"},
        "h has 2 bodies; give one of them by --body, 1 to 2"),
    "axes of HAMS": (edited(hams, "h", "h/Input/ControlFile.in"), {"Reference_body_length": "LCS 1 2 3 0\n"
        "Reference_body_length"}, {"Reference_body_length": "LCS 1 2 3 5\nReference_body_length"},
        "LCS turns the body about z; allowed: axes parallel to those of the water"),
    "mass of HAMS": (edited(hams, "h", "h/Input/Hydrostatic.in"), {}, {" Body Mass Matrix:": " Body Mass Matrix:\n 1"},
        "Hydrostatic.in has another content; allowed: the centre of gravity, then the mass matrix as six rows of six "
        "numbers"),
    "units of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {"UnitsSystem: SI": "UnitsSystem: US"},
        {"UnitsSystem: SI": "UnitsSystem: Imperial"}, "UnitsSystem is 'Imperial'; allowed: SI, US or User"),
    "length of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {"UnitsSystem: SI": "UnitsSystem: User\n  LengthUnits: "
        "ft"}, {"UnitsSystem: SI": "UnitsSystem: User\n  LengthUnits: yd"}, "LengthUnits is 'yd'; allowed: m, km, mm"),
    "force of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"),
        {"UnitsSystem: SI": "UnitsSystem: User\n  ForceUnits: MN"},
        {"UnitsSystem: SI": "UnitsSystem: User\n  ForceUnits: dyn"}, "ForceUnits is 'dyn'; allowed: kN, N, MN"),
    "points of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {"RAOOrigin: [0.0,": "RAOOrigin: [0.9e-9,"},
        {"RAOOrigin: [0.0,": "RAOOrigin: [1.1e-9,"},
        "RAOOrigin of LoadRAOs is not ReferenceOrigin; allowed: one point for both"),
    "waves of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {"    RAOWaveUnit: amplitude\n": ""},
        {"RAOWaveUnit: amplitude": "RAOWaveUnit: double amplitude"},
        "RAOWaveUnit is double amplitude; allowed here: amplitude"),
    "sides of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {"    SwayPositive: port\n": ""},
        {"SwayPositive: port": "SwayPositive: starboard"}, "SwayPositive is starboard; allowed here: port"),
    "bow of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {}, {"PitchPositiveBow: down": "PitchPositiveBow: up"},
        "PitchPositiveBow is up; allowed here: down"),
    "roll of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {}, {"RollPositiveStarboard: down":
        "RollPositiveStarboard: up"}, "RollPositiveStarboard is up; allowed here: down"),
    "keys of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {}, {"ReferenceOrigin:": "Origin:"},
        "a.yml has no ReferenceOrigin; allowed: a model of OrcaFlex with a vessel type"),
    "numbers of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {}, {"WaterDepth: 20.0": "WaterDepth: deep"},
        "a.yml is no model of OrcaFlex: "),
    "frequencies of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {"AMDPeriodOrFrequency: 1.0":
        "AMDPeriodOrFrequency: 1.0000009"}, {"AMDPeriodOrFrequency: 1.0\n": "AMDPeriodOrFrequency: 1.1\n",
        "AMDPeriodOrFrequency: 2.0": "AMDPeriodOrFrequency: 2.0000021"},
        "LoadRAOs does not have the frequencies of the added mass; allowed: the same"),
    "text of OrcaFlex": (edited(orcaflex, "a.yml", "a.yml"), {}, {"General:": "General: {"}, "a.yml, line "),
    "frequencies of WAMIT": (of_wamit, {}, {".1": " 0.0 1 1 1.0\n -1.0 1 1 1.0\n"},
        "a.1 has no frequency between 0 and infinity"),
    "damping of WAMIT": (of_wamit, {}, {".1": FORMAT_1.replace(" 0.5", "")},
        "a.1 lacks damping; allowed: five numbers a line for each period between 0 and infinity"),
    "drift of WAMIT": (of_wamit, {".8": "".join(f" {T} {b} {b} {i} 1.0 0.0 1.0 0.0\n" for T in (6.283185, 3.141593)
        for b in (0.0, 90.0) for i in (1, 2, 6))}, {".8": " 6.283185 0.0 90.0 1 1.0 0.0 1.0 0.0\n"},
        "a.8 has drift for pairs of different headings only; it also needs the drift for each single heading"),
    "forces of WAMIT": (of_wamit, {}, {".3": " 5.0 0.0 1 1.0 0.0 1.0 0.0\n"},
        "a.3 does not have the periods and headings of the other files; allowed: the same; it has no 6.2832, 3.14"),
    "headings of WAMIT": (of_wamit, {}, {".3": "".join(f" {T} {b} 1 1.0 0.0 1.0 0.0\n" for T in (6.283185, 3.141593)
        for b in (0.0, 80.0)), ".2": "".join(f" {T} {b} 1 1.0 0.0 1.0 0.0\n" for T in (6.283185, 3.141593)
        for b in (0.0, 90.0))}, "does not have the periods and headings of the other files;"),
    "places of WAMIT": (of_wamit, {".hst": " 1 1 1.0\n 1 1 1.0\n"}, {".hst": " 1 1 1.0\n 1 1 1.1\n"},
        "a.hst: 2 values for 1, 1; allowed: exactly one value for each combination"),
    "depth of WAMIT": (of_wamit_alone, {".pot": POT.format("0 0 0 0")}, {}, "--depth is missing, and "),
    "ULEN of WAMIT": (of_wamit_alone, {".gdf": GDF.format(1.0), ".pot": POT.format("0 0 0 0")},
        {".gdf": GDF.format(0.0)}, "a.gdf, line 2: ULEN is missing; allowed: a length above 0, or give --length-unit"),
    "IPEROUT of WAMIT": (of_wamit, {".cfg": "IPEROUT = 1\n"}, {".cfg": "IPEROUT = 5\n"},
        "a.cfg: IPEROUT is 5; allowed: 1, 2, 3, 4"),
    "axes of WAMIT": (of_wamit, {".pot": POT.format("0 0 0 0")}, {".pot": POT.format("0 0 0 5")},
        "a.pot: XBODY(4) turns the body by 5°; allowed: 0"),
    "end of a .pot": (of_wamit, {".pot": POT.format("0 0 0 0")}, {".pot": POT.format("0 0 0")},
        "a.pot ends before XBODY; give --about x,y,z and leave the file out, or mend the file"),
    "periods of a listing": (in_file("a.out", wamit.read), out(), out(period=""),
        "a.out is not an output of WAMIT, or it ends before the first period"),
    "coefficients of a listing": (in_file("a.out", wamit.read), out(), out(mass="VELOCITY"),
        "a.out has no added mass and damping; allowed: a run with IOPTN(1) = 1"),
    "turn of a listing": (in_file("a.out", wamit.read), out(), out(turned=30.0),
        "a.out: PHIBODY turns the body by 30°; allowed: 0"),
    "steps of pairs": (pairs, of_pairs(1.0, 2.0, 3.0008), of_pairs(1.0, 2.0, 3.006),
        "a.12d has periods that are not at equal steps of frequency; allowed: equal steps"),
    "two frequencies of pairs": (pairs, of_pairs(1.0, 2.0), of_pairs(1.0), "that are not at equal steps of frequency;"),
}  # fmt: skip


@pytest.mark.parametrize("name", LIMITS)
def test_a_sound_file_is_read_and_one_beyond_a_limit_refused(name, tmp_path):
    read, sound, faulty, says = LIMITS[name]
    for folder in ("sound", "faulty"):
        (tmp_path / folder).mkdir()
    more = read is hydrostar_folder
    read(tmp_path / "sound", **sound) if more else read(tmp_path / "sound", sound)
    with pytest.raises(FormatError) as refused:
        read(tmp_path / "faulty", **faulty) if more else read(tmp_path / "faulty", faulty)
    assert says in str(refused.value)


@pytest.mark.parametrize("asked, count, chosen", [
    (None, 1, 0), (1, 1, 0), (1, 3, 0), (3, 3, 2), (None, 2, None), (0, 2, None), (4, 3, None),
])  # fmt: skip
def test_one_of_several_bodies_is_asked_for_by_its_number(asked, count, chosen):
    known = {} if asked is None else {"body": asked}
    if chosen is not None:
        assert body_of("a.1", count, known) == chosen
        return
    with pytest.raises(FormatError) as refused:
        body_of("a.1", count, known)
    head = "" if asked is None else f"--body is {asked}, "
    assert str(refused.value).startswith(f"{head}a.1 has {count} bodies; give one of them by --body, 1 to {count}")


@pytest.mark.parametrize("module", [bemio, capytaine])
def test_what_is_no_hdf5_cannot_be_opened(module, tmp_path):
    (tmp_path / "a.h5").write_bytes(b"CDX")
    with pytest.raises(FormatError, match=r"a\.h5 cannot be opened: "):
        module.read(tmp_path / "a.h5")


def test_a_limit_that_is_infinite_for_some_motions_is_no_row_of_orcaflex(tmp_path):
    for limit, there in ((np.eye(6), True), (np.diag([1.0, 1, np.inf, 1, 1, 1]), False)):
        orcaflex.write(one_body(added_mass_infinity=limit), tmp_path / "a.yml")
        assert ("AMDPeriodOrFrequency: Infinity" in (tmp_path / "a.yml").read_text()) is there


@pytest.mark.parametrize("solved, forces, common", [
    ([1, 2, 3, 4], [2, 2.5, 3, 3.5], [2, 3]), ([1, 2, 3, 4], [3, 4.5], [3]), ([1, 2, 3, 4], [2.5, 3, 3.5], None),
])  # fmt: skip
def test_of_a_model_of_orcaflex_the_frequencies_are_kept_that_both_tables_have_and_half_of_the_fewer_must_be(
    tmp_path, solved, forces, common
):
    """The coefficients are 100 times their frequency, in t"""
    path = tmp_path / "a.yml"
    A = 1e5 * np.array(solved, float)[:, None, None] * np.eye(6)
    made = {"added_mass": A, "radiation_damping": A, "excitation_force": np.ones((len(solved), 2, 6)) + 0j}
    orcaflex.write(replace(one_body(), omega=np.array(solved, float), quantities=made), path)
    model = YAML(typ="safe", pure=True).load(path.read_text())
    for heading in model["VesselTypes"][0]["Draughts"][0]["LoadRAOs"]["RAOs"]:
        heading[orcaflex.RAO_COLUMNS] = [[one, *[one, 0.0] * 6] for one in forces]
    path.write_text(f"%YAML 1.1\n---\n{json.dumps(model, default=str)}\n")
    if common is None:
        with pytest.raises(FormatError, match="LoadRAOs does not have the frequencies of the added mass"):
            orcaflex.read(path, KNOWN)
        return
    found = orcaflex.read(path, KNOWN)
    assert found.omega == pytest.approx(common)
    assert found.quantities["added_mass"][:, 0, 0] == pytest.approx(1e5 * np.array(common))
    assert found.quantities["excitation_force"][:, 1, 2] == pytest.approx(1e3 * np.array(common))
