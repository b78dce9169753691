"""WAMIT's listing, AQWA's and Diodore's files, by hand from their manuals' tables; several bodies in one."""

import h5py
import numpy as np
import pytest

from hakobune.bem.formats import aqwa, bemio, capytaine, diodore, hydrostar, nemoh, wamit
from hakobune.bem.formats.values import FormatError, Values
from hakobune.bem.formats.wamit_out import mass_of

RHO, G = 1000.0, 9.81
KNOWN = {"water_depth": None, "density": RHO, "gravity": G}


def matrix(start):
    return start + np.arange(36.0).reshape(6, 6)


OUT = """
                        WAMIT  Version 7.063

                               N=  1     one.gdf
                               N=  2     two.gdf
 Gravity:     9.81000                Length scale:        2.00000
 Water depth:        30.00000

 Body number: N= 1       Total panels:  10
 XBODY =    0.0000 YBODY =    0.0000 ZBODY =   -1.0000 PHIBODY =   0.0
 Volumes (VOLX,VOLY,VOLZ):           100.0      101.0      102.0
 Center of Buoyancy (Xb,Yb,Zb):     0.000000     0.000000    -0.500000
 C(3,3),C(3,4),C(3,5):   5.0     0.0 0.25
 C(4,4),C(4,5),C(4,6):                7.0      0.0   0.0
        C(5,5),C(5,6):                             8.0       0.0
 Center of Gravity  (Xg,Yg,Zg):     0.000000     0.000000     0.250000
 Body number: N= 2       Total panels:  10
 XBODY =    9.0000 YBODY =    0.0000 ZBODY =   -2.0000 PHIBODY =   0.0

 Wave period = infinite                                 Wavenumber = zero
    ADDED-MASS COEFFICIENTS
     I     J         A(I,J)
     3     3   4.0E+00

 Wave period (sec) =  5.000000E+00        Wavenumber (kL) =  4.0E-02
    ADDED-MASS AND DAMPING COEFFICIENTS
     I     J         A(I,J)         B(I,J)
     3     3   2.0E+00   1.0E-01
     3     9   9.0E+00   9.0E+00
     9     9   3.0E+00   2.0E-01
     5     1   0.5E+00   0.0E+00
    DIFFRACTION EXCITING FORCES AND MOMENTS
  Wave Heading (deg) :     30
     I     Mod[Xh(I)]     Pha[Xh(I)]
     3   6.0E+00             90
     9   8.0E+00              0
 SURGE, SWAY & YAW DRIFT FORCES (Momentum Conservation)
  Wave Heading (deg) :     30       30
     I     Mod[F(I)]     Pha[F(I)]
     1   1.5E+00            180
"""


def test_a_listing_of_wamit_is_read_as_its_files(tmp_path):
    """A = ρ L³ Ā, A₅₁ = ρ L⁴ Ā, B = ρω L³ B̄, X = ρg L² X̄ of exp(+iωt), C₃₅ = ρg L³ C̄, F = ρg L F̄"""
    place = tmp_path / "two.out"
    place.write_text(OUT)
    with pytest.raises(FormatError, match="has 2 bodies; give one of them by --body, 1 to 2"):
        wamit.read(place, KNOWN)
    one, two = (wamit.read(place, KNOWN | {"body": body}) for body in (1, 2))
    w = 2 * np.pi / 5
    assert one.omega == pytest.approx([w]) and one.wave_direction == pytest.approx([np.radians(30)])
    assert one.get("added_mass")[0, 2, 2] == pytest.approx(RHO * 8 * 2.0)
    assert one.get("added_mass")[0, 4, 0] == pytest.approx(RHO * 16 * 0.5)
    assert one.get("radiation_damping")[0, 2, 2] == pytest.approx(RHO * w * 8 * 0.1)
    assert one.get("excitation_force")[0, 0, 2] == pytest.approx(RHO * G * 4 * -6j)
    assert two.get("excitation_force")[0, 0, 2] == pytest.approx(RHO * G * 4 * 8)
    assert two.get("radiation_damping")[0, 2, 2] == pytest.approx(RHO * w * 8 * 0.2)
    assert one.get("added_mass_zero")[2, 2] == pytest.approx(RHO * 8 * 4.0) and one.get("drift_force_fixed")[
        0, 0, 0
    ] == (pytest.approx(-1.5 * RHO * G * 2))
    C = one.get("hydrostatic_stiffness")
    assert (C[2, 2], C[2, 4], C[4, 2], C[4, 4]) == pytest.approx(
        RHO * G * np.array([5 * 4, 0.25 * 8, 0.25 * 8, 8 * 16])
    )
    both = wamit.coupled(place, KNOWN, 2)
    assert both["added_mass"][0, 2, [2, 8]] == pytest.approx(RHO * 8 * np.array([2.0, 9.0]))
    assert both["radiation_damping"][0, 8, 8] == pytest.approx(RHO * w * 8 * 0.2) and both["added_mass_zero"].shape == (
        12,
        12,
    )
    assert one.body["displaced_volume"] == 101.0 and one.body["center_of_mass"] == pytest.approx([0, 0, -0.75])
    assert (one.water_depth, one.gravity, one.others) == (30.0, 9.81, 1) and two.rotation_center[0] == 9.0
    w = f"{w:.6E}"
    (tmp_path / "two.1").write_text(f" {w} 3 3 2.0 0.1\n {w} 9 9 3.0 0.2\n")
    beside = wamit.read(tmp_path / "two.1", KNOWN | {"body": 2})  # the listing says what the first column is
    assert beside.omega == pytest.approx(two.omega, rel=1e-6) and beside.water_depth == 30.0
    assert beside.get("added_mass")[0, 2, 2] == pytest.approx(two.get("added_mass")[0, 2, 2])
    assert beside.rotation_center == pytest.approx(two.rotation_center)
    place.write_text(OUT.split(" Wave period =")[0])
    with pytest.raises(FormatError, match="ends before the first period"):
        wamit.read(place, KNOWN | {"body": 1})


def numbers(rows, start):
    return "\n".join(
        ("  " + start if i == 0 else "       ") + " ".join(f"{x:.4E}" for x in row) for i, row in enumerate(rows)
    )


def test_numbers_of_aqwa_are_about_the_centre_of_gravity_with_its_phases(tmp_path):
    """X exp(ik x_G) for a wave along x, with deep water k = ω²/g"""
    place = tmp_path / "a.AH1"
    text = "* DATE\n  1  2  1  0.0  90.0\n   1.0\nGENERAL\n  1  20000.0  1025.0  9.81  0\n"
    text += "COG\n  1  2.0  0.0  -1.0\n  2  -2.0  0.0  -1.0\nDRAFT\n  1 3.0\n  2 3.0\n"
    text += "MASS\n" + numbers(7 * np.eye(6), "1 ") + "\n" + numbers(8 * np.eye(6), "2 ") + "\n"
    for name, start in (("ADDEDMASS", 100.0), ("DAMPING", 200.0)):
        text += name + "\n"
        for i, j in ((1, 1), (1, 2), (2, 1), (2, 2)):
            text += numbers(matrix(start * (10 * i + j)), f"{i} {j} 1 ") + "\n"
    text += "FORCERAO\n"
    for body in (1, 2):
        for heading in (1, 2):
            text += f"  {body} {heading} 1 " + "5.0 " * 6 + "\n   " + "90.0 " * 6 + "\n"
    place.write_text(text)
    two = aqwa.read(place, {"body": 2})
    assert two.get("added_mass")[0] == pytest.approx(matrix(2200.0)) and two.get("mass") == 8.0
    assert two.get("radiation_damping")[0] == pytest.approx(matrix(4400.0))
    for name, start in (("added_mass", 100.0), ("radiation_damping", 200.0)):
        both = aqwa.coupled(place, {}, 2)[name]
        assert both.shape == (1, 12, 12)
        for i, j in ((1, 1), (1, 2), (2, 1), (2, 2)):  # on structure i by motions of structure j
            block = both[0, 6 * i - 6 : 6 * i, 6 * j - 6 : 6 * j]
            assert block == pytest.approx(matrix(start * (10 * i + j)))
    assert (two.water_depth, two.density, two.others) == (np.inf, 1025.0, 1)
    assert two.rotation_center.tolist() == [-2, 0, -1]
    assert two.get("excitation_force")[0, 0] == pytest.approx(5j * np.exp(-2j / 9.81))
    assert two.get("excitation_force")[0, 1] == pytest.approx(5j)
    place.write_text(text.replace("\n  1 2 1 ", "\n  1 1 1 "))
    with pytest.raises(FormatError, match=r"a.AH1 lacks added mass between structures; with --bodies give a run"):
        aqwa.coupled(place, {}, 2)
    with pytest.raises(FormatError, match=r"a.LIS gives one structure at a time; with --bodies give the .AH1"):
        aqwa.coupled(tmp_path / "a.LIS", {}, 2)
    place.write_text("GENERAL\n 1 20.0 1025.0 32.2\nCOG\n 1 0 0 0\n")
    with pytest.raises(FormatError, match=r"a.AH1 is no file of AQWA|gravity"):
        aqwa.read(place, {})


LISTING = """
          WATER  DEPTH  . . . . . . =     70.0000
          DENSITY  OF  WATER  . . . =    1025.000
          ACCELERATION  DUE  TO GRAVITY . . =       9.810
   * * * * H Y D R O D Y N A M I C   P A R A M E T E R S   F O R   S T R U C T U R E   1 * * * *
          THE CENTRE OF GRAVITY  AT (  0.0000E+00,   0.0000E+00,  -1.0000E+00)
          WAVE PERIOD =  62.834   WAVE FREQUENCY =  0.1000
               ADDED  MASS
{A}
               DAMPING
{B}
   FROUDE KRYLOV + DIFFRACTION FORCES-VARIATION WITH WAVE PERIOD/FREQUENCY
   62.83   0.100   -180.00  6.0  90.00  0.0  0.0  4.0  -0.00  0.0 0.0  0.0 0.0  0.0 0.0
   62.83   0.100      0.00  6.0 -90.00  0.0  0.0  4.0  -0.00  0.0 0.0  0.0 0.0  0.0 0.0
"""


def test_a_listing_of_aqwa(tmp_path):
    place = tmp_path / "a.LIS"
    rows = {
        name: "\n\n".join(
            f"   {side}  " + "  ".join(f"{x:.1f}" for x in row)
            for side, row in zip(aqwa.SIDES, matrix(start), strict=True)
        )
        for name, start in (("A", 10.0), ("B", 60.0))
    }
    place.write_text(LISTING.format(**rows))
    found = aqwa.read(place)
    assert found.get("added_mass")[0] == pytest.approx(matrix(10.0)) and found.omega.tolist() == [0.1]
    assert found.get("radiation_damping")[0] == pytest.approx(matrix(60.0)) and found.water_depth == 70.0
    X = found.get("excitation_force")[0]
    assert np.degrees(found.wave_direction).tolist() == [-180, 0]
    assert X[0, 0] == pytest.approx(6j) and X[1, 0] == pytest.approx(-6j) and X[1, 2] == pytest.approx(4)
    place.write_text(LISTING.format(A="", B=""))
    with pytest.raises(FormatError, match="no added mass and damping of structure 1"):
        aqwa.read(place)


@pytest.mark.parametrize("aqua", [False, True])
def test_a_data_base_of_diodore(aqua, tmp_path):
    """F = i |F| exp(iφ); AQUA+ calls the incident part of it so, and gives no sum"""
    place = tmp_path / "a.hdb"
    text = "[SOFT] X\n[FORWARD_SPEED]   0.00\n[UNDERWATER_VOLUME] 50.0\n[CENTER_OF_GRAVITY] 0.0 0.0 -1.5\n"
    text += ("[FROUDE-KRYLOV_FORCES_AND_MOMENTS]" if aqua else "[EXCITATION_FORCES_AND_MOMENTS]") + "\n"
    for part, row in (("MOD", "3.0 " * 6), ("PH", "0.5 " * 6)):
        text += f"[INCIDENCE_EFM_{part}_001]  30.0\n 2.0 {row}\n 4.0 {row}\n"
    for i in range(1, 7):
        text += f"[ADDED_MASS_LINE_{i}]\n 2.0 {' '.join(map(str, matrix(5)[i - 1]))}\n 4.0 {'1.0 ' * 6}\n"
        text += f"[DAMPING_TERM_{i}]\n 2.0 {'0.25 ' * 6}\n 4.0 {'0.5 ' * 6}\n"
    place.write_text(text)
    with pytest.raises(FormatError, match=r"--depth is missing, and .* does not give the depth"):
        diodore.read(place, KNOWN)
    found = diodore.read(place, KNOWN | {"water_depth": 25.0})
    assert found.omega == pytest.approx([np.pi / 2, np.pi]) and found.get("added_mass")[1] == pytest.approx(matrix(5))
    assert found.get("radiation_damping")[0, 0, 0] == 0.5 and found.rotation_center.tolist() == [0, 0, -1.5]
    name = "Froude_Krylov_force" if aqua else "excitation_force"
    assert found.get(name)[0, 0] == pytest.approx(3j * np.exp(0.5j)) and found.body["displaced_volume"] == 50.0
    assert (found.get("excitation_force") is None) == aqua
    place.write_text(text.replace("   0.00", "   5.00"))
    with pytest.raises(FormatError, match="is for a body with forward speed; allowed: speed 0"):
        diodore.read(place, KNOWN | {"water_depth": 25.0})


MMX = """ WAMIT -- Force Output File -- a.mmx

 Gravity:     9.81000                Length scale:        1.00000

 NBODY =     2       IALTFRC = 1

 WAMIT  Ouputs for body N =     1    IALTFRCN = 1
 Volumes (VOLX,VOLY,VOLZ):           9.0      9.0      9.0
 Normalized mass matrix:
     I     J     MASS(I,J)/RHO
     1     1     9.0E+00
 WAMIT  Ouputs for body N =     2    IALTFRCN = {kind}
 Volumes (VOLX,VOLY,VOLZ):           4.1      4.0      3.9
 Center of Buoyancy (Xb,Yb,Zb):     0.000000     0.000000    -0.250000
 Center of Gravity:  (Xg,Yg,Zg)     0.000000     0.500000     0.000000

 {title}:
     I     J     MASS(I,J)
{rows}
     1     7   8.0E+00   0.0   0.0
"""


@pytest.mark.parametrize("kind, title, factor", [(1, "Normalized mass matrix", RHO), (2, "External force matrices", 1)])
def test_volume_centres_and_mass_of_a_body_of_wamit(kind, title, factor, tmp_path):
    place = tmp_path / "a.mmx"
    rows = [f"     {i}     {i}   {m}   0.0   0.0" for i, m in enumerate((4.0, 4.0, 4.0, 1.5, 2.5, 3.0), 1)]
    place.write_text(MMX.format(kind=kind, title=title, rows="\n".join(rows)))
    body = mass_of(place, 1, RHO, np.array([10.0, 0.0, -1.0]))
    assert body["displaced_volume"] == 4.0 and body["mass"] == 4.0 * factor
    assert body["center_of_buoyancy"].tolist() == [10, 0, -1.25] and body["center_of_mass"].tolist() == [10, 0.5, -1]
    assert body["inertia_matrix"].diagonal() == pytest.approx(np.array([4, 4, 4, 1.5, 2.5, 3]) * factor)
    first = mass_of(place, 0, RHO, np.zeros(3))
    assert first["mass"] == 9 * RHO and "inertia_matrix" not in first  # no inertia in rotation
    with pytest.raises(FormatError, match="has 2 bodies; allowed: as many as the other files have"):
        mass_of(place, 2, RHO, np.zeros(3))


def test_drift_of_other_headings_is_left_out_and_said(single, tmp_path):
    wamit.write(single, tmp_path / "a.1")
    rows = "".join(f" 6.28 45.0 45.0 {i} 1.0 0.0 1.0 0.0\n" for i in (1, 2, 6))
    (tmp_path / "a.9").write_text(rows)
    found = wamit.read(tmp_path / "a.1", KNOWN | {"water_depth": 20.0})
    assert found.get("drift_force_fixed") is None and found.wave_direction.tolist() == [0.0]
    assert "a.9 does not have the periods and headings of the other files;" in found.left_out[0]


def test_stiffness_of_six_numbers_beside_capytaine(single, tmp_path):
    place = tmp_path / "a.nc"
    capytaine.write(single, place)
    with h5py.File(place, "a") as file:
        del file["hydrostatic_stiffness"]
        file.create_dataset("hydrostatic_S", data=np.arange(6.0)).make_scale("hydrostatic_S")
        file.create_dataset("hydrostatic_stiffness", data=[33.0, 34.0, 35.0, 44.0, 45.0, 55.0])
        file["hydrostatic_stiffness"].dims[0].attach_scale(file["hydrostatic_S"])
    C = capytaine.read(place).get("hydrostatic_stiffness")
    assert C[2, 2:5].tolist() == [33, 34, 35] and C[3, 3:5].tolist() == [44, 45] and C[4, 4] == 55
    assert np.array_equal(C, C.T) and not C[:2].any() and not C[5].any()


@pytest.fixture
def single():
    A = np.stack([matrix(10.0), matrix(20.0)])
    quantities = {"added_mass": A, "radiation_damping": A / 10, "excitation_force": np.ones((2, 1, 6)) * (1 + 2j)}
    body = {"center_of_mass": np.zeros(3), "center_of_buoyancy": np.zeros(3), "displaced_volume": 1.0,
            "hydrostatic_stiffness": matrix(0.0)}  # fmt: skip
    return Values(np.array([1.0, 2.0]), np.zeros(1), 20.0, RHO, G, quantities, body, name="a")


def test_the_second_of_two_bodies_of_bemio_has_its_own_columns(single, tmp_path):
    place = tmp_path / "a.h5"
    bemio.write(single, place)
    with h5py.File(place, "a") as file:
        file.copy("body1", "body2")
        for body, start in (("body1", 0), ("body2", 6)):
            for name in ("added_mass/all", "radiation_damping/all", "added_mass/inf_freq"):
                group = file[f"{body}/hydro_coeffs"]
                own = group[name][()]
                wide = np.full((6, 12, *own.shape[2:]), 1e9)
                wide[:, start : start + 6] = own * (2 if start else 1)
                del group[name]
                group[name] = wide
    with pytest.raises(FormatError, match="2 bodies; give one of them by --body, 1 to 2"):
        bemio.read(place)
    assert bemio.read(place, {"body": 1}).get("added_mass") == pytest.approx(single.get("added_mass"))
    assert bemio.read(place, {"body": 2}).get("added_mass") == pytest.approx(2 * single.get("added_mass"))
    with h5py.File(place, "a") as file:
        del file["body2/hydro_coeffs/linear_restoring_stiffness"]
        file["body2/hydro_coeffs/linear_restoring_stiffness"] = np.zeros((0, 0))
    assert bemio.read(place, {"body": 2}).get("hydrostatic_stiffness") is None
    with pytest.raises(FormatError, match=r"--body is 3, .* has 2 bodies"):
        bemio.read(place, {"body": 3})


def test_a_body_of_capytaine_is_told_by_the_name_before_its_modes(single, tmp_path):
    place = tmp_path / "a.nc"
    capytaine.write(single, place)
    with h5py.File(place, "a") as file:
        for axis in ("radiating_dof", "influenced_dof"):
            file[axis][...] = [f"{'one' if i < 2 else 'two'}__{dof}" for i, dof in enumerate(
                ("heave", "Surge", "Surge", "Sway", "Heave", "Pitch"))]  # fmt: skip
    one, two = (capytaine.read(place, {"body": body}).get("added_mass")[0] for body in (1, 2))
    assert (one[2, 2], one[2, 0], one[0, 0], one[4, 4]) == (10.0, 11.0, 17.0, 0.0)  # modes in whatever order and case
    assert (two[0, 0], two[4, 4], two[0, 4], two[3, 3]) == (24.0, 45.0, 27.0, 0.0)


def test_what_capytaine_needs_to_export_is_there(single, tmp_path):
    drift = np.arange(6.0).reshape(2, 1, 3)
    single.quantities["drift_force"] = drift
    capytaine.write(single, tmp_path / "a.nc")
    with h5py.File(tmp_path / "a.nc") as file:
        said = file.attrs["coordinates"].split()
        assert {"g", "rho", "water_depth", "forward_speed", "period"} <= set(said) and file["forward_speed"][()] == 0
        assert file["drift_force_yaw"][1, 0, 0] == 5.0
    assert capytaine.read(tmp_path / "a.nc").get("drift_force") == pytest.approx(drift)


def test_nemoh_s_input_is_read_by_its_lines_and_two_bodies_by_their_zones(single, tmp_path):
    nemoh.write(single, tmp_path)
    bare = [line.split("!")[0] for line in (tmp_path / "Nemoh.cal").read_text().splitlines() if line[:3] != "---"]
    (tmp_path / "Nemoh.cal").write_text("\n".join(bare))
    assert nemoh.read(tmp_path).get("added_mass") == pytest.approx(single.get("added_mass"))
    start = next(i for i, line in enumerate(bare) if "Mesh/" in line)
    body = bare[start:-6]
    crest = [line.replace("0. 0.", "3. 0.") if i == 3 else line for i, line in enumerate(bare[:start])]
    two = [*crest[:-1], "2", *body, *body, *bare[-6:]]
    (tmp_path / "Nemoh.cal").write_text("\n".join(two))
    A = single.get("added_mass")
    whole = np.block([[A, 0 * A], [0 * A, 3 * A]])
    zones = ['VARIABLES="f (Hz)"']
    for j in range(12):
        zones.append(f'Zone t="{j}"')
        for n, w in enumerate(single.omega):
            pairs = np.column_stack([whole[n, :, j], whole[n, :, j] / 10]).ravel()
            zones.append(" ".join(f"{x:.9E}" for x in (w / (2 * np.pi), *pairs)))
    (tmp_path / "Results" / "RadiationCoefficients.tec").write_text("\n".join(zones))
    rows = ['VARIABLES="f (Hz)"', "Zone"]
    rows += [" ".join(f"{x:.9E}" for x in (w / (2 * np.pi), *[2.0, 0.25] * 12)) for w in single.omega]
    (tmp_path / "Results" / "ExcitationForce.tec").write_text("\n".join(rows))
    second = nemoh.read(tmp_path, {"body": 2})
    assert second.get("added_mass") == pytest.approx(3 * A) and second.omega == pytest.approx(single.omega)
    from hakobune.bem.waves import wavenumber

    k = wavenumber(single.omega, 20.0, G)  # phases are of a crest 3 m ahead of the origin
    assert second.get("excitation_force")[:, 0, 4] == pytest.approx(2 * np.exp(0.25j + 3j * k))


def test_a_folder_of_hydrostar_has_a_triangle_and_the_other_time_factor(tmp_path):
    """A₅₁ stands for A₁₅; a surge at +90° of exp(+iωt) is −i of ours, turned by the crest at 5 m: exp(5ik)"""
    head = """# Project :
#     Water density (rho)  :  1000.0000
#     Gravity acceleration :     9.8100
#     Waterdepth           :     inf
#     Ref.pt incident wave : (   5.0000   0.0000)
#            Forward speed :   {speed}  m/s
# Reference point of body 1: (   1.0000   0.0000  -2.0000)
#RAOTYPE    :  {kind}
#COMPONENT  : {mode}
#HEADING          0.00
"""
    files = {("ADDED-MASS", "11"): (7.0, 0), ("ADDED-MASS", "51"): (3.0, 0), ("WAVE-DAMPING", "11"): (2.0, 0),
             ("LOAD", "1"): (4.0, 90), ("MOTION", "1"): (9.0, 0)}  # fmt: skip
    for (kind, mode), (size, phase) in files.items():
        rows = f"  2.0 {2 * size} {phase}.0\n  1.0  {size}  {phase}.0\n#ENDFILE\n"
        (tmp_path / f"{kind}_{mode}.rao").write_text(head.format(speed="0.0000", kind=kind, mode=mode) + rows)
    found = hydrostar.read(tmp_path)
    assert (
        found.omega.tolist() == [1, 2] and np.isinf(found.water_depth) and found.rotation_center.tolist() == [1, 0, -2]
    )
    A = found.get("added_mass")
    assert (A[0, 0, 0], A[0, 4, 0], A[1, 0, 4]) == (7, 3, 6) and found.get("radiation_damping")[0, 0, 0] == 2
    k = np.array([1.0, 4.0]) / 9.81
    assert found.get("excitation_force")[:, 0, 0] == pytest.approx(np.array([4, 8]) * -1j * np.exp(5j * k))
    (tmp_path / "ADDED-MASS_11.rao").write_text(
        head.format(speed="1.5", kind="ADDED-MASS", mode="11") + "1.0 1.0 0.0\n"
    )
    with pytest.raises(FormatError, match=r"forward speed of 1.5 m/s"):
        hydrostar.read(tmp_path)
    (tmp_path / "ADDED-MASS_11.rao").write_text(head.format(speed="0.0", kind="ADDED-MASS", mode="11"))
    with pytest.raises(FormatError, match="has a header but no rows"):
        hydrostar.read(tmp_path)
    (tmp_path / "ADDED-MASS_11.rao").write_text("#RAOTYPE : ADDED-MASS\n#COMPONENT : 11\n1.0 1.0 0.0\n")
    with pytest.raises(FormatError, match="does not have the header and rows that HydroStar"):
        hydrostar.read(tmp_path / "LOAD_1.rao")
