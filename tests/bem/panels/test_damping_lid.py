"""Damping lids on the water between hulls: laws with their losses counted, and limits."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.modes import Body
from hakobune.bem.panels import damping_lid
from hakobune.bem.panels.damping_lid import DampingLid
from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix
from hakobune.meshing.panels import assembled, with_symmetry
from hakobune.meshing.shapes import box

OMEGA, HEADINGS = 2.05, [0.0, np.pi / 2, 0.6]
WANT = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed", "kochin_radiation",
        "kochin_diffraction"}  # fmt: skip
GAP = np.array([[-4, -0.4], [4, -0.4], [4, 0.4], [-4, 0.4]])


def two_barges(lids, symmetry="xy", panels=120, **more):
    """8 × 3 × 1.5 m each, 0.8 m between them, whose water resonates near 2.05 rad/s"""
    hull = with_symmetry(box(8.0, 3.0, 1.5, panels=panels), "x")
    mesh = with_symmetry(assembled([hull.moved(dy=1.9), hull.moved(dy=-1.9)]), symmetry.replace("y", ""))
    bodies = Body("north", (0, 1.9, 0)), Body("south", (0, -1.9, 0))
    return PanelProblem(mesh, None, depth=9.0, bodies=bodies, damping_lids=tuple(lids), **more)


def solved(problem, want=WANT):
    return solve_frequency(problem.prepared(), OMEGA, HEADINGS, want)


@pytest.fixture(scope="module")
def damped():
    return solved(two_barges([DampingLid(GAP, 0.1)]))


def test_laws_hold_with_what_the_lid_takes(damped):
    """Z = Zᵀ; Haskind's forces with the lid's exchange; B = waves far away and ρωεK∬φφ̄dS; −Re H(β) alike"""
    checks = damped["checks"]
    assert checks["reciprocity"] < 0.01 and checks["Haskind"] < 0.01 and checks["energy"] < 0.01
    H = damped["kochin_diffraction"]
    forward = H[1, round(H.shape[1] / 4)]  # π/2 is among the angles
    lost = -forward.real - np.mean(np.abs(H[1]) ** 2)
    assert H.shape[1] % 4 == 0 and lost > 0.1 * -forward.real, lost / forward.real


def test_a_lid_without_damping_is_open_water(damped):
    open_water, nothing = solved(two_barges([])), solved(two_barges([DampingLid(GAP, 1e-9)]))
    for name in ("added_mass", "radiation_damping", "excitation_force", "drift_force_fixed"):
        size = np.abs(open_water[name]).max()
        assert np.abs(open_water[name] - nothing[name]).max() < 1e-6 * size
        assert np.abs(open_water[name] - damped[name]).max() > 0.05 * size


def test_a_stiff_lid_lets_no_wave_into_the_gap():
    """ε without bound holds φ + φ_I at zero on it: a hundred times more of it changes what is left by its share"""
    some, more = (solved(two_barges([DampingLid(GAP, e)]), {"excitation_force"}) for e in (1e4, 1e6))
    size = np.abs(more["excitation_force"]).max()
    assert np.abs(some["excitation_force"] - more["excitation_force"]).max() < 1e-3 * size


def test_mirror_planes_change_nothing(damped):
    whole = solved(two_barges([DampingLid(GAP, 0.1)], symmetry=""), {"added_mass", "excitation_force"})
    for name in ("added_mass", "excitation_force"):
        assert np.abs(whole[name] - damped[name]).max() < 1e-3 * np.abs(damped[name]).max()


def carried_less(H):
    """W per m² of amplitude that waves from π/2 bring and do not carry away, ρgC_g/(πk) (−2π Re H(β) − ∫|H|²dθ)"""
    k = OMEGA**2 / 9.80665  # tanh kh = 0.9999
    return 1025 * 9.80665 * OMEGA / k**2 * (-H[len(H) // 4].real - np.mean(np.abs(H) ** 2))


def test_the_power_that_a_lid_takes_is_what_the_waves_lose():
    """½ρωεK∬|ψ|²dS on the lid against the far field, of barges at rest and of barges that float"""
    lids = [DampingLid(GAP, 0.1)]
    fixed = solved(two_barges(lids), {*WANT, "damping_lid_power"})
    assert fixed["damping_lid_power"][1] == pytest.approx(carried_less(fixed["kochin_diffraction"][1]), rel=0.01)
    still, M, C = hydrostatics(box(8.0, 3.0, 1.5, panels=120)), *np.zeros((2, 12, 12))
    for own in (slice(6), slice(6, 12)):
        M[own, own], C[own, own] = inertia_matrix(still.mass, (0, 0, 0), (1, 2.5, 2.5), (0, 0, 0)), still.stiffness
    floating = two_barges(lids, panels=240, inertia_matrix=M, hydrostatic_stiffness=C)
    free = solved(floating, {*WANT, "rao", "damping_lid_power"})
    H = free["kochin_diffraction"][1] + free["rao"][1] @ free["kochin_radiation"]
    assert free["damping_lid_power"][1] == pytest.approx(carried_less(H), rel=0.005)  # 4 % of half as many panels
    assert abs(free["damping_lid_power"][1] / fixed["damping_lid_power"][1] - 1) > 0.1


@pytest.mark.parametrize("corners, width", [
    ([(0, 0), (8, 0), (8, 0.8), (0, 0.8)], 0.8), ([(0, 0), (4, 0), (0, 3)], 2.4),
    ([(0, 0), (6, 0), (4, 2), (1, 2)], 2.0), ([(0, 0), (2, 0), (2, 9), (0, 9)], 2.0),
])  # fmt: skip
def test_a_lid_is_as_wide_as_its_corners_are_from_the_nearest_side(corners, width):
    """Of a triangle of 3, 4 and 5 m the height on the longest side"""
    turned = np.array(corners, float) @ [[0.6, 0.8], [-0.8, 0.6]] + [5.0, -2.0]
    assert damping_lid._width(turned) == pytest.approx(width)


@pytest.mark.parametrize("narrow, size", [(0.8, 0.4), (40.0, 3.0)])
def test_panels_of_lids_are_as_those_of_the_hull_or_two_across_the_narrowest(narrow, size, monkeypatch):
    """The side of a mean square, 3 m of 9 m²; each node of a lid has that lid's damping; 8000 nodes at most"""
    asked = []

    def patches(corners, size, symmetry):
        asked.append((len(corners), size, symmetry))
        return "surface", np.array([2, 3])

    made = SimpleNamespace(elements=SimpleNamespace(nodes=range(8000)))
    monkeypatch.setattr(damping_lid, "patches", patches)
    monkeypatch.setattr(damping_lid, "Geometry", lambda *them, modes: asked.append(them) or made)
    lids = [
        DampingLid(np.array([(0, 0), (50, 0), (50, width), (0, width)]), damping)
        for width, damping in ((45.0, 0.1), (narrow, 0.3))
    ]
    mesh = SimpleNamespace(areas=np.array([8.0, 10.0]), symmetry="x")
    problem = SimpleNamespace(mesh=mesh, damping_lids=lids, lid=None, depth=9.0, nodes_per_panel=4, modes=())
    geometry, damping = damping_lid.with_damping_lids(problem)
    assert geometry is made and damping.tolist() == [0.1] * 8 + [0.3] * 12
    assert asked == [(2, pytest.approx(size), "x"), (mesh, "surface", 9.0, 4)]
    made.elements.nodes = range(8001)
    with pytest.raises(ValueError, match="hull and lids have 8001 nodes; allowed with damping lids: 8000"):
        damping_lid.with_damping_lids(problem)
