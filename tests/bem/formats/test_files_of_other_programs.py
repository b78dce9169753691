"""A database in the files of other programs, read by their published layouts, and back.

The readers here share nothing with `bem.formats`: text by columns, HDF5 by dataset, netCDF by xarray.
"""

from dataclasses import replace

import h5py
import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.formats import bemio, capytaine, hams, nemoh, orcaflex, wamit
from hakobune.bem.formats.values import FormatError, about, values_of
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

DIGITS = 6e-7  # relative, of numbers printed with seven
RHO, G, DEPTH = 1025.0, 9.80665, 20.0
WATER = {"water_depth": DEPTH, "density": RHO, "gravity": G}


@pytest.fixture(scope="module")
def values(tmp_path_factory):
    """A box off its middle in even frequencies and headings, so that no entry vanishes by symmetry of the axes"""
    path = tmp_path_factory.mktemp("formats") / "barge.h5"
    raw = {
        "water": {"depth": DEPTH},
        "bodies": [{"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0, "gyration": [6, 12, 13]}],
        "waves": {"omegas": [0.1, 0.4, 0.7], "headings_deg": [0, 45, 90]},
        "rotation_center": [2.0, 1.0, -1.0],
    }
    solve(make_scene(raw), path)
    return values_of(open_database(path))


def close(found, true, digits=DIGITS):
    return np.all(np.abs(found - true) <= digits * np.abs(true) + 1e-12 * np.abs(true).max())


def test_wamit_divides_by_density_and_has_the_other_time_factor(values, tmp_path):
    wamit.write(values, tmp_path / "barge")
    lines = [line.split() for line in (tmp_path / "barge.1").read_text().splitlines()]
    rows = np.array([line for line in lines if len(line) == 5], float)
    assert len(rows) == 3 * 36 and {line[0] for line in lines if len(line) == 4} <= {"-1.000000E+00", "0.000000E+00"}
    for period, i, j, A, B in rows:
        n = int(np.argmin(np.abs(2 * np.pi / values.omega - period)))
        place = n, int(i) - 1, int(j) - 1
        assert close(A * RHO, values.get("added_mass")[place])
        assert close(B * RHO * values.omega[n], values.get("radiation_damping")[place])
    for _, beta, i, size, phase, re, im in np.loadtxt(tmp_path / "barge.3")[:18]:
        x = re + 1j * im
        assert np.isclose(size * np.exp(1j * np.radians(phase)), x, rtol=1e-5, atol=1e-4)
        m = int(np.argmin(np.abs(np.degrees(values.wave_direction) - beta)))
        true = values.get("excitation_force")[0, m, int(i) - 1]
        assert np.isclose(RHO * G * np.conj(x), true, rtol=1e-5, atol=1e-6 * abs(true))


def test_a_long_head_wave_pushes_where_it_falls(values, tmp_path):
    """F_x ~ −∂η/∂x: a quarter period ahead of the crest, +90° in exp(+iωt) and −90° in exp(−iωt)."""
    wamit.write(values, tmp_path / "barge")
    nemoh.write(values, tmp_path / "folder")
    period, beta, mode, _, phase, *_ = np.loadtxt(tmp_path / "barge.3").T
    first = (period == period.max()) & (beta == 0) & (mode == 1)
    assert np.allclose(phase[first], 90, atol=5)
    zone = (tmp_path / "folder/Results/ExcitationForce.tec").read_text().split("Zone")[1].splitlines()[1].split()
    assert np.isclose(float(zone[2]), -np.pi / 2, atol=0.1)


def test_another_point_changes_moments_by_the_arm_and_no_power(values):
    """M′ = M + r × F and v′ = v − r × ω of a rigid body, r from the new point to the old; F·v stays"""
    point = np.array([-3.0, 2.0, -4.0])
    moved = about(values, point)
    r = values.rotation_center - point
    F, X = (values.get(name) for name in ("excitation_force", "rao"))
    F_new, X_new = (moved.get(name) for name in ("excitation_force", "rao"))
    assert np.allclose(F_new[..., :3], F[..., :3])
    assert np.allclose(F_new[..., 3:], F[..., 3:] + np.cross(r, F[..., :3]))
    assert np.allclose(X_new[..., :3], X[..., :3] - np.cross(X[..., 3:], r))
    assert np.allclose(np.sum(F_new * X_new, -1), np.sum(F * X, -1))
    M, A = moved.get("inertia_matrix"), moved.get("added_mass")
    assert np.allclose(M[4, 0], values.get("mass") * (values.get("center_of_mass") - point)[2])
    C, B = moved.get("hydrostatic_stiffness"), moved.get("radiation_damping")
    w = values.omega[1]
    Z = -(w**2) * (M + A[1]) - 1j * w * B[1] + C
    assert np.allclose(Z @ X_new[1].T, F_new[1].T, rtol=1e-9, atol=1e-9 * np.abs(F_new[1]).max())
    D, D_new = (each.get("drift_force") for each in (values, moved))
    assert np.allclose(D_new[..., 2], D[..., 2] + r[0] * D[..., 1] - r[1] * D[..., 0])
    back = about(moved, values.rotation_center)
    assert np.allclose(back.get("added_mass"), values.get("added_mass"), rtol=1e-12)


def test_bemio_has_the_shapes_that_its_writer_makes(values, tmp_path):
    bemio.write(values, tmp_path / "barge.h5")
    values = about(values, values.get("center_of_mass"))  # where WEC-Sim has the origin of a body
    with h5py.File(tmp_path / "barge.h5") as file:
        hydro, n, m = file["body1/hydro_coeffs"], 3, 3
        assert hydro["added_mass/all"].shape == (6, 6, n) and hydro["excitation/re"].shape == (6, m, n)
        assert np.allclose(hydro["added_mass/all"][2, 4] * RHO, values.get("added_mass")[:, 2, 4])
        B = values.get("radiation_damping") / values.omega[:, None, None]
        assert np.allclose(hydro["radiation_damping/all"][4, 0] * RHO, B[:, 4, 0])
        phase = hydro["excitation/phase"][0, 0, 0]
        assert np.isclose(phase, -np.angle(values.get("excitation_force")[0, 0, 0]))
        K = hydro["radiation_damping/impulse_response_fun/K"][2, 2, 0]
        w = values.omega  # at t = 0 the integral of B alone, of straight lines B/ω times ω
        fine = np.linspace(w[0], w[-1], 20001)
        exact = 2 / np.pi * np.trapezoid(np.interp(fine, w, B[:, 2, 2]) * fine, fine) / RHO
        assert np.isclose(K, exact, rtol=1e-5)
        assert file["simulation_parameters/w"].shape == (n, 1) and file["body1/properties/cg"].shape == (3, 1)
        assert file["body1/properties/name"].dtype.kind == "S"  # text of fixed length, which WEC-Sim's readers take


def test_xarray_reads_the_file_of_capytaine_by_labels(values, tmp_path):
    xarray = pytest.importorskip("xarray")
    capytaine.write(values, tmp_path / "barge.nc")
    with xarray.open_dataset(tmp_path / "barge.nc", engine="h5netcdf") as data:
        F = data.excitation_force.sel(influenced_dof="Heave", omega=0.4, wave_direction=np.pi / 4, method=None)
        true = values.get("excitation_force")[1, 1, 2]
        assert np.isclose(complex(F.sel(complex="re"), F.sel(complex="im")), true)
        A = data.added_mass.sel(radiating_dof="Pitch", influenced_dof="Surge").values
        assert np.array_equal(A, values.get("added_mass")[:, 0, 4])
        assert float(data.rho) == RHO and float(data.water_depth) == DEPTH


@pytest.mark.parametrize(
    "form, name, digits",
    [(wamit, "barge", DIGITS), (hams, "folder", DIGITS), (nemoh, "folder", 1e-9), (bemio, "b.h5", 1e-14),
     (capytaine, "b.nc", 1e-15), (orcaflex, "b.yml", 1e-14)],
    ids=lambda value: getattr(value, "__name__", ""),
)  # fmt: skip
def test_what_is_written_is_read_to_the_printed_digits(form, name, digits, values, tmp_path):
    form.write(values, tmp_path / name)
    found = form.read(tmp_path / name, WATER)
    if form is bemio:
        values = about(values, found.rotation_center)
    assert close(found.omega, values.omega, digits) and np.allclose(found.wave_direction, values.wave_direction)
    assert {"added_mass", "radiation_damping", "excitation_force"} <= set(found.quantities)
    assert (found.water_depth, found.density, found.gravity) == (DEPTH, RHO, G)
    for quantity, value in found.quantities.items():
        true = values.get(quantity)
        if form is orcaflex and true.shape[-2:] == (6, 6) and quantity != "rao":
            true = (true + np.swapaxes(true, -1, -2)) / 2  # reciprocity made exact, which OrcaFlex demands
        size = np.abs(true).max(axis=tuple(range(1, true.ndim)) if true.ndim > 2 else None, keepdims=True)
        assert np.all(np.abs(value - true) <= 2 * digits * size + 1e-15 * np.abs(true).max()), quantity
    stiffness = values.get("hydrostatic_stiffness")
    assert np.allclose(found.get("hydrostatic_stiffness"), stiffness, rtol=0, atol=1e-6 * stiffness.max())
    if form is not wamit:  # which does not say it
        assert np.allclose(found.rotation_center, values.rotation_center, atol=1e-6)


def test_orcaflex_gets_symmetric_matrices_the_weight_apart_and_phases_that_lag(values, tmp_path):
    from ruamel.yaml import YAML

    orcaflex.write(values, tmp_path / "barge.yml")
    vessel = YAML(typ="safe", pure=True).load((tmp_path / "barge.yml").read_text())["VesselTypes"][0]
    draught = vessel["Draughts"][0]
    rows = draught["FrequencyDependentAddedMassAndDamping"]
    assert rows[0]["AMDPeriodOrFrequency"] == "Infinity"
    for row in rows:
        A = np.array(next(row[key] for key in row if key.startswith("AddedMassMatrixX,")))
        assert np.array_equal(A, A.T)
    V, zB = values.get("displaced_volume"), values.get("center_of_buoyancy")[2]
    waterplane = 40.0 * 20.0**3 / 12 + 40.0 * 20.0 * 1.0**2  # about the rotation centre, at y = 1 m and z = −1 m
    K = draught["HydrostaticStiffnessz, HydrostaticStiffnessRx, HydrostaticStiffnessRy"]
    assert np.isclose(K[1][1], RHO * G / 1e3 * (waterplane + V * (zB + 1.0)))
    heading = draught["LoadRAOs"]["RAOs"][2]
    heave = [row[5] * np.exp(1j * np.radians(row[6])) for row in heading[orcaflex.RAO_COLUMNS]]
    assert heading["RAODirection"] == 90 and np.allclose(heave, values.get("excitation_force")[:, 2, 2] / 1e3)


def test_deep_water_comes_back_as_deep_water(values, tmp_path):
    deep = replace(values, water_depth=np.inf)
    for form, name in ((nemoh, "n"), (hams, "h"), (bemio, "b.h5"), (capytaine, "c.nc")):
        form.write(deep, tmp_path / name)
        assert form.read(tmp_path / name, WATER).water_depth == np.inf


def test_uneven_frequencies_and_damaged_files_are_refused(values, tmp_path):
    with pytest.raises(FormatError, match="evenly spaced"):
        nemoh.write(replace(values, omega=np.array([0.1, 0.2, 0.7])), tmp_path / "folder")
    wamit.write(values, tmp_path / "barge")
    path = tmp_path / "barge.1"
    whole = path.read_text().splitlines()
    path.write_text("\n".join(whole[:-1]))
    with pytest.raises(FormatError, match="0 values for"):
        wamit.read(path, WATER)
    path.write_text("\n".join([*whole, "1.0 2 x"]))
    with pytest.raises(FormatError, match="is not a number"):
        wamit.read(path, WATER)
    path.write_text("\n".join(whole))
    plain = wamit.read(path, WATER).get("added_mass")
    path.write_text("\n".join([*whole[:-1], f"{whole[-1]}\t!a spring: 0.0"]))  # as in a set of OC3-Hywind
    np.testing.assert_array_equal(wamit.read(path, WATER).get("added_mass"), plain)
    bemio.write(values, tmp_path / "b.h5")
    with pytest.raises(FormatError, match="no file of Capytaine"):
        capytaine.read(tmp_path / "b.h5", None)


def test_nemoh_2_titles_and_nemoh_3_folders_are_read(values, tmp_path):
    nemoh.write(values, tmp_path)
    for name in ("Mesh", "Results"):
        (tmp_path / name).rename(tmp_path / name.lower())
    path = tmp_path / "results" / "ExcitationForce.tec"
    path.write_text(path.read_text().replace("Excitation force - beta", "Diffraction force - beta"))
    said = tmp_path / "Nemoh.cal"
    said.write_text(said.read_text().replace("Mesh/", "mesh\\"))
    found = nemoh.read(tmp_path)
    assert close(found.get("excitation_force"), values.get("excitation_force"), 1e-8)
    assert found.get("hydrostatic_stiffness") is not None and nemoh.hull_of(tmp_path).is_file()
    said.write_text(said.read_text().replace("2 0. 0. 1. 2.000000", "2 0. 0. 1. 3.000000"))
    with pytest.raises(FormatError, match="about several points"):
        nemoh.read(tmp_path)


def test_periods_of_six_digits_are_those_of_seven(values, tmp_path):
    """As WAMIT prints those of .3fk, with a zero before the point"""
    wamit.write(values, tmp_path / "barge")
    path = tmp_path / "barge.3fk"
    lines = [line.split() for line in path.read_text().splitlines()]
    path.write_text("\n".join(" ".join([f"{float(f'{float(row[0]):.5e}'):.6E}", *row[1:]]) for row in lines))
    assert close(wamit.read(tmp_path / "barge.1", WATER).get("Froude_Krylov_force"), values.get("Froude_Krylov_force"))


def test_netcdf_3_is_read_as_netcdf_4(values, tmp_path):
    from scipy.io import netcdf_file

    capytaine.write(values, tmp_path / "four.nc")
    with h5py.File(tmp_path / "four.nc") as new, netcdf_file(tmp_path / "three.nc", "w") as old:
        axes = {name: len(data) for name, data in new.items() if data.is_scale}
        for axis, count in (axes | {"letters": 5}).items():
            old.createDimension(axis, count)
        for name, data in new.items():
            if name == "body_name":
                continue
            text = data.dtype.kind == "O"
            places = (name,) if data.is_scale else tuple(scale.values()[0].name[1:] for scale in data.dims)
            kept = old.createVariable(name, "c" if text else "f8", (*places, "letters") if text else places)
            if text:
                kept[:] = np.array([list(word.decode().ljust(5, "\0")) for word in data[()]], "S1")
            elif places:
                kept[:] = data[()]
            else:
                kept[...] = data[()]
    found = capytaine.read(tmp_path / "three.nc")
    for quantity in capytaine.TAKEN:
        assert np.array_equal(found.get(quantity), values.get(quantity)), quantity
    assert np.allclose(found.rotation_center, values.rotation_center)
