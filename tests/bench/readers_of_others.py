"""Run by another Python, in which programs of others are installed: reads a file with one of them into arrays.

    python readers_of_others.py READER FILE OUT.npz

OUT has omega (n,), headings (m,) degrees, A, B (n, 6, 6) and F (n, m, 6), in the units and with the phases of the
reader, which `read_by_others.py` knows.  A reader that is not installed ends with status 3.
"""

import sys
from pathlib import Path

import numpy as np


def wamit_by_pyhams(place):
    """pyHAMS: divided by density (and gravity), phases of WAMIT"""
    from pyhams.pyhams import read_wamit1, read_wamit3

    A, B, omega = read_wamit1(f"{place}.1", TFlag=1)
    _, _, real, imag, at, headings = read_wamit3(f"{place}.3", TFlag=1)
    keep = np.isfinite(omega) & (omega > 0)
    order, waves = np.argsort(omega[keep]), np.argsort(at)
    F = (real + 1j * imag).transpose(2, 0, 1)[waves]
    return omega[keep][order], headings, *(M.transpose(2, 0, 1)[keep][order] for M in (A, B)), F


def wamit_by_raft(place):
    """RAFT: in SI about the origin, phases of WAMIT, forces along and across the wave"""
    from types import SimpleNamespace

    from pyhams.pyhams import read_wamit3
    from raft.raft_fowt import FOWT

    omega = np.unique(np.array(read_wamit3(f"{place}.3", TFlag=1)[4]))
    n = len(omega)
    stub = SimpleNamespace(
        hydroPath=str(place), w=omega, nw=n, A_BEM=np.zeros((6, 6, n)), B_BEM=np.zeros((6, 6, n)), nDOF=6,
        rho_water=1025.0, g=9.80665, reducedDOF=[[0, 0]], nodeList=[SimpleNamespace(r0=np.zeros(6))],
    )  # fmt: skip
    FOWT.readHydro(stub)
    X = stub.X_BEM.transpose(2, 0, 1).copy()
    c, s = np.cos(np.radians(stub.BEM_headings)), np.sin(np.radians(stub.BEM_headings))
    for i in (0, 3):
        X[..., i], X[..., i + 1] = c * X[..., i] - s * X[..., i + 1], s * X[..., i] + c * X[..., i + 1]
    return omega, stub.BEM_headings, stub.A_BEM.transpose(2, 0, 1), stub.B_BEM.transpose(2, 0, 1), X


def netcdf_out_by_capytaine(place):
    """What Capytaine writes for WAMIT of a netCDF file"""
    import capytaine
    import xarray
    from capytaine.io.xarray import merge_complex_values

    capytaine.export_dataset(str(place.with_name("again")), merge_complex_values(xarray.open_dataset(place)), "wamit")
    return wamit_by_pyhams(place.with_name("again"))


def netcdf_by_mafredo(place):
    from mafredo.hyddb1 import Hyddb1

    return _of_mafredo(Hyddb1.create_from_capytaine(str(place)))


def orcaflex_by_mafredo(place):
    from mafredo.hyddb1 import Hyddb1

    return _of_mafredo(Hyddb1.create_from_orcaflex_yml(str(place), vessel_type_name=place.stem))


def _of_mafredo(found):
    """kN and t"""
    omega = np.array([w for w in found._mass.omega.values if 0 < w < np.inf])
    headings = np.sort(np.unique(np.asarray(found._force[0].wave_directions, float)))
    A, B = (np.stack([np.asarray(M.sel(omega=w)) for w in omega]) for M in (found._mass, found._damping))
    F = np.array([[found.force(w, beta) for beta in headings] for w in omega])
    return omega, headings, A * 1e3, B * 1e3, F * 1e3


def netcdf_by_xarray(place):
    import xarray
    from capytaine.io.xarray import merge_complex_values

    data = merge_complex_values(xarray.open_dataset(place))
    F = data["excitation_force"].transpose("omega", "wave_direction", "influenced_dof").values
    A, B = (
        data[name].transpose("omega", "influenced_dof", "radiating_dof").values
        for name in ("added_mass", "radiation_damping")
    )
    keep = np.isfinite(data.omega.values) & (data.omega.values > 0)
    return data.omega.values[keep], np.degrees(data.wave_direction.values), A[keep], B[keep], F[keep]


def bemio_by_wecsim(place):
    """The body class of WEC-Sim's port to Python (source/objects of its repository on PYTHONPATH, numpy 1)"""
    import bodyClass

    found = bodyClass.BodyClass(str(place))
    found.bodyNumber, found.bodyTotal = 1, [1]
    rows = []
    found.readH5file()
    water = found.hydroData["simulation_parameters"]
    omega, headings = water["w"][0], water["wave_dir"][0]
    for w in omega:
        found.readH5file()  # its methods change what was read
        found.constAddedMassAndDamping(w, 1, 1.0, 0)
        force = []
        for beta in headings:
            found.readH5file()
            found.regExcitation([w], beta, 1.0, 1.0)
            force.append(found.hydroForce["fExt"]["re"] + 1j * found.hydroForce["fExt"]["im"])
        rows.append((found.hydroForce["fAddedMass"], found.hydroForce["fDamping"] / w, force))
    return omega, headings, *map(np.array, zip(*rows, strict=True))


def moordyn_by_moorpy(place):
    """Tensions at both ends of each line, N, as A of one frequency"""
    import moorpy

    system = moorpy.System(file=str(place))  # depth and water are in the file
    system.initialize()
    A = np.zeros((1, 6, 6))
    for n, line in enumerate(system.lineList):
        A[0, n, :2] = line.TA, line.TB
    return np.zeros(1), np.zeros(1), A, A, 0.0


def mesh_by_capytaine(place):
    """Volume and wetted area of the mesh file, as A and B of one frequency"""
    import capytaine

    mesh = capytaine.load_mesh(str(place)).immersed_part()
    return np.zeros(1), np.zeros(1), np.full((1, 6, 6), mesh.volume), np.full((1, 6, 6), mesh.faces_areas.sum()), 0.0


READERS = {
    name: made for name, made in globals().items() if callable(made) and "_by_" in name and not name.startswith("_")
}

if __name__ == "__main__":
    reader, place, out = sys.argv[1:]
    try:
        omega, headings, A, B, F = READERS[reader](Path(place))
    except ImportError as missing:
        print(missing)
        sys.exit(3)
    np.savez(out, omega=omega, headings=headings, A=A, B=B, F=F)
