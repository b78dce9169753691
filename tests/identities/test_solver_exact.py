"""The panel solver against exact solutions: order of convergence and final error.

Errors are relative to the largest value of the same coefficient over the frequencies; at each frequency also to
|A + iB/ω| and to the largest excitation (moments by the radius).
"""

import numpy as np
import pytest
from exact import maccamy_fuchs
from exact.hemisphere import hemisphere
from exact.truncated_cylinder import TruncatedCylinder

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import PanelMesh, joined, structured
from hakobune.meshing.shapes import buoy

G = 9.80665
WANT = frozenset({"added_mass", "radiation_damping", "excitation_force", "diffraction_force", "drift_force_fixed"})
KH = np.array([0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0])


def prepared(mesh, depth):
    return prepare(PanelProblem(mesh, lid(mesh), depth=depth))


def frequencies(kh, depth):
    return np.sqrt(G * kh / depth * np.tanh(kh))


def cylinder_errors(counts, depth, radius=10.0, draft=10.0):
    """Largest relative error of A, B (surge, heave, pitch, surge-pitch), excitation and drift over KH."""
    body = prepared(buoy(radius, draft, counts=counts), depth)
    dofs = [0, 2, 4]
    rows = []
    for omega in frequencies(KH, depth):
        r = solve_frequency(body, omega, [0.0], WANT)
        exact = TruncatedCylinder(radius, draft, depth, omega)
        Z = [a[np.ix_(dofs, dofs)] for a in (r["added_mass"], r["radiation_damping"] / omega)]
        E = [a[np.ix_(dofs, dofs)] for a in (exact.added_mass(), exact.damping() / omega)]
        size = np.sqrt(np.abs(np.diag(E[0] + 1j * E[1])))
        X, EX = (f[dofs] / [1, 1, radius] for f in (r["excitation_force"][0], exact.excitation(0.0)))
        F, EF = r["drift_force_fixed"][0, 0], exact.drift_fixed(0.0)[0]
        rows.append((np.array([a - e for a, e in zip(Z, E, strict=True)]), np.array(E), size, X - EX, EX, F - EF, EF))
    dZ, E, size, dX, EX, dF, EF = (np.array(column) for column in zip(*rows, strict=True))
    pairs = ([0, 1, 2, 0], [0, 1, 2, 2])
    overall = np.abs(dZ).max(axis=0)[:, *pairs] / np.abs(E).max(axis=0)[:, *pairs]
    by_frequency = np.abs(dZ).max(axis=1) / (size[:, :, None] * size[:, None, :])
    return {
        "A": overall[0].max(),
        "B": overall[1].max(),
        "A + iB/ω": by_frequency[:, *pairs].max(),
        "excitation": (np.abs(dX).max(axis=0) / np.abs(EX).max(axis=0)).max(),
        "excitation at each frequency": (np.abs(dX).max(axis=1) / np.abs(EX).max(axis=1)).max(),
        "drift": np.abs(dF).max() / np.abs(EF).max(),
    }


@pytest.mark.parametrize("depth", [10.2, 15.0, 30.0, 100.0])
def test_truncated_cylinder_is_exact_to_half_a_per_cent(depth):
    fine = cylinder_errors((11, 9, 13), depth)  # 968 panels on the whole hull
    assert fine.pop("drift") < 0.01
    assert max(fine.values()) < 0.005, fine


@pytest.mark.parametrize("depth", [10.2, 30.0])
def test_truncated_cylinder_converges_at_second_order(depth):
    coarse, fine = cylinder_errors((5, 5, 7), depth), cylinder_errors((10, 10, 14), depth)
    # four times the panels, half the size: at least order 1.7, the singular edge limiting it below 2
    for name in ("A", "B", "A + iB/ω"):
        assert np.log2(coarse[name] / fine[name]) > 1.7, (name, coarse, fine)


@pytest.mark.parametrize("radius, draft, depth", [(30.0, 5.0, 8.0), (5.0, 20.0, 40.0)])
def test_flat_and_slender_cylinders_too(radius, draft, depth):
    body = prepared(buoy(radius, draft, panels=500), depth)
    for omega in frequencies(np.array([0.1, 0.5, 1.0]), depth):
        r, exact = solve_frequency(body, omega, [0.0], WANT), TruncatedCylinder(radius, draft, depth, omega)
        for dof in (0, 2, 4):
            Z = (r["added_mass"] + 1j * r["radiation_damping"] / omega)[dof, dof]
            E = (exact.added_mass() + 1j * exact.damping() / omega)[dof, dof]
            assert abs(Z - E) < 0.01 * abs(E)
        assert r["drift_force_fixed"][0, 0] == pytest.approx(exact.drift_fixed(0.0)[0], rel=0.01)


def test_freely_floating_cylinder_drifts_as_it_should():
    radius, draft, depth = 10.0, 10.0, 30.0
    mesh = buoy(radius, draft, panels=500)
    mass = 1025 * np.pi * radius**2 * draft
    inertia = mass * np.diag([1, 1, 1, 40.0, 40.0, 50.0])
    stiffness = 1025 * G * np.pi * radius**2 * np.diag([0, 0, 1.0, 10.0, 10.0, 0])
    body = prepare(PanelProblem(mesh, lid(mesh), depth=depth, inertia_matrix=inertia, hydrostatic_stiffness=stiffness))
    ours, exact = [], []
    for omega in frequencies(np.array([0.5, 1.0, 2.0, 4.0, 8.0]), depth):
        ours.append(solve_frequency(body, omega, [0.7], {"drift_force"})["drift_force"][0, :2])
        exact.append(TruncatedCylinder(radius, draft, depth, omega).drift_free(0.7, inertia, stiffness))
    assert np.abs(np.array(ours) - exact).max() < 0.01 * np.abs(exact).max()


def octant_sphere(n):
    """Floating hemisphere of radius 1 and exact volume, three patches of n × n panels an octant."""
    tangent = np.tan(np.pi / 4 * np.arange(n + 1) / n)
    a, b = np.meshgrid(tangent, tangent, indexing="ij")
    patches = []
    for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        v = np.stack([np.ones_like(a), a, b], axis=-1) / np.sqrt(1 + a**2 + b**2)[..., None]
        patch = structured(v[..., order] * [1, 1, -1])
        patches.append(patch if patch.volume > 0 else patch.flipped())
    mesh = joined(patches)
    scale = (np.pi / 6 / mesh.volume) ** (1 / 3)
    return PanelMesh(mesh.points * scale, mesh.corners, "xy")


def test_hemisphere_in_deep_water_converges_to_hulme():
    numbers, worst = (4, 8), []
    waves = np.array([0.1, 0.5, 1.0, 2.0, 5.0])
    for n in numbers:
        body, errors = prepared(octant_sphere(n), np.inf), []
        for Ka in waves:
            omega = np.sqrt(G * Ka)
            r = solve_frequency(body, omega, [], {"added_mass", "radiation_damping"})
            scale = 2 / 3 * np.pi * 1025
            ours = [
                [r[q][d, d] / scale / f for q, f in (("added_mass", 1), ("radiation_damping", omega))] for d in (2, 0)
            ]
            errors.append((ours, [hemisphere(Ka, mode) for mode in ("heave", "surge")]))
        ours, exact = np.array([e[0] for e in errors]), np.array([e[1] for e in errors])
        worst.append((np.abs(ours - exact).max(axis=0) / np.abs(exact).max(axis=0)).max())
    assert worst[1] < 0.005, worst
    assert np.log2(worst[0] / worst[1]) > 1.8, worst  # flat panels: the shape converges at second order


def test_pile_on_the_bed_converges_to_maccamy_and_fuchs():
    radius, depth = 10.0, 15.0
    kh, worst = np.array([0.1, 0.5, 1.0, 2.0, 4.0]), []
    for counts in ((4, 1, 4), (8, 1, 8)):
        body = prepared(buoy(radius, depth, counts=counts, bottom=False), depth)
        ours, exact = [], []
        for omega in frequencies(kh, depth):
            r = solve_frequency(body, omega, [0.3], WANT)
            A, B = maccamy_fuchs.surge_radiation(radius, depth, omega)
            ours.append([*r["excitation_force"][0, [0, 1, 3, 4]], *r["drift_force_fixed"][0, :2],
                         r["added_mass"][0, 0], r["radiation_damping"][0, 0]])  # fmt: skip
            exact.append([*maccamy_fuchs.excitation(radius, depth, omega, 0.3)[[0, 1, 3, 4]],
                          *maccamy_fuchs.drift(radius, depth, omega, 0.3), A, B])  # fmt: skip
        worst.append((np.abs(np.array(ours) - exact).max(axis=0) / np.abs(exact).max(axis=0)).max())
    assert worst[1] < 0.003, worst
    assert np.log2(worst[0] / worst[1]) > 1.8, worst
