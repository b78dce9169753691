"""Several bodies by panels: against published numbers, and against arrangements that must give the same."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.drift import sum_about_origin
from hakobune.bem.flexible.beams import Beam
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.modes import Body, Mode
from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import assembled, with_symmetry
from hakobune.meshing.shapes import box, buoy

FIRST = {"added_mass", "radiation_damping", "excitation_force"}
MIRRORED = np.array([1, -1, 1, -1, 1, -1.0])  # motions of an image in y = 0
PANELS = 48


def solved(hulls, bodies, want=FIRST, omega=1.1, headings=(0.0, 0.7), **more):
    problem = PanelProblem(assembled(hulls), None, depth=9.0, bodies=tuple(bodies), **more)
    return solve_frequency(problem.prepared(), omega, headings, want)


@pytest.fixture(scope="module")
def barge():
    return box(8.0, 4.0, 1.5, panels=PANELS).whole()


@pytest.fixture(scope="module")
def pair(barge):
    """Two barges side by side, the second half as large and turned by 0.4 rad"""
    hulls = [barge.moved(dy=4.0), barge.scaled(0.5).rotated(0.4).moved(dx=1.0, dy=-2.5)]
    bodies = [Body("barge", (0.0, 4.0, 0.2)), Body("tug", (1.0, -2.5, 0.0), 0.4)]
    return hulls, bodies, solved(hulls, bodies, FIRST | {"kochin_diffraction", "kochin_radiation"})


def test_two_truncated_cylinders_of_published_coefficients():
    """a = 10, draft 10 in 20 m, at x = ∓12.5 m, ω = 0.8: values by an expansion in eigenfunctions; errors of 200 panels
    a body are a quarter to a half of these bounds"""
    half = with_symmetry(buoy(10.0, 10.0, panels=200), "y")
    mesh = assembled([half.moved(dx=-12.5), half.moved(dx=12.5)])
    bodies = Body("west", (-12.5, 0, 0)), Body("east", (12.5, 0, 0))
    problem = PanelProblem(mesh, lid(mesh), depth=20.0, density=1000.0, gravity=9.81, bodies=bodies)
    found = solve_frequency(problem.prepared(), 0.8, [0.0], FIRST | {"drift_force_fixed"})
    A, B, force = found["added_mass"], found["radiation_damping"], found["excitation_force"][0]
    assert [A[0, 0], A[2, 2]] == pytest.approx([2954147.8, 1812068.2], rel=7e-3)
    assert A[0, 6] == pytest.approx(-1562178.2, rel=7e-3) and A[2, 8] == pytest.approx(-15769.4, rel=0.02)
    assert [B[2, 2], B[2, 8]] == pytest.approx([460981.0, 237206.5], rel=1e-3)
    assert abs(force[0] - (-2518943 - 1332175j)) < 4e-3 * abs(force[0])
    assert abs(force[6] - (2322799 - 1051619j)) < 4e-3 * abs(force[6])
    assert found["drift_force_fixed"][0, 0] == pytest.approx(19895.3, rel=4e-3)


def test_a_list_of_one_body_gives_the_same_bits(barge):
    alone = PanelProblem(barge, None, depth=9.0, rotation_center=(0.5, 0.1, 0.2))
    listed = replace(alone, mesh=assembled([barge]), rotation_center=(0, 0, 0), bodies=(Body("it", (0.5, 0.1, 0.2)),))
    one, other = (solve_frequency(p.prepared(), 1.1, [0.3], {*FIRST, "kochin_radiation"}) for p in (alone, listed))
    assert all(np.array_equal(one[name], other[name]) for name in (*FIRST, "kochin_radiation"))


def test_laws_hold_over_all_motions(pair):
    """Z = Zᵀ, Haskind's forces, energy that waves carry away and scatter: errors of so few panels"""
    checks = pair[2]["checks"]
    assert checks["reciprocity"] < 0.01 and checks["Haskind"] < 0.01 and checks["energy"] < 0.01
    assert pair[2]["added_mass"].shape == (12, 12) and pair[2]["kochin_radiation"].shape[0] == 12


def test_turning_and_moving_everything_changes_phases_alone(pair):
    """In axes that turn with a body nothing else can change: all turned by 0.6 rad and moved by r, A and B stay, and
    forces in waves turned alike are times exp(ik·r)"""
    hulls, bodies, found = pair
    turn, shift = 0.6, np.array([3.0, -2.0])
    c, s = np.cos(turn), np.sin(turn)

    def carried(point):
        x, y, z = point
        return (c * x - s * y + shift[0], s * x + c * y + shift[1], z)

    moved = [hull.rotated(turn).moved(dx=shift[0], dy=shift[1]) for hull in hulls]
    others = [Body(b.name, carried(b.rotation_center), b.heading + turn) for b in bodies]
    again = solved(moved, others, headings=(turn, 0.7 + turn))
    for name in ("added_mass", "radiation_damping"):
        assert again[name] == pytest.approx(found[name], rel=1e-6, abs=1e-6 * np.abs(found[name]).max())
    from hakobune.bem.waves import wavenumber

    k = float(wavenumber(1.1, 9.0, 9.80665))
    along = [k * (np.cos(b + turn) * shift[0] + np.sin(b + turn) * shift[1]) for b in (0.0, 0.7)]
    phase = np.exp(1j * np.array(along))[:, None]
    force = found["excitation_force"]
    assert again["excitation_force"] == pytest.approx(phase * force, abs=1e-6 * np.abs(force).max())


def test_two_equal_bodies_and_their_mirror(barge):
    """Moving as mirror images two bodies have the plane between them for a wall (images of a vortex, Milne-Thomson)"""
    beside = barge.moved(dy=3.5)
    image = replace(beside, points=beside.points * [1, -1, 1]).flipped()
    two = solved([beside, image], [Body("here", (0, 3.5, 0)), Body("there", (0, -3.5, 0))])
    walled = PanelProblem(beside, None, depth=9.0, wall=0.0, rotation_center=(0, 3.5, 0))
    one = solve_frequency(walled.prepared(), 1.1, [0.0, 0.7], FIRST)
    for name in ("added_mass", "radiation_damping"):
        symmetric = two[name][:6, :6] + two[name][:6, 6:] * MIRRORED
        assert one[name] == pytest.approx(symmetric, rel=1e-7, abs=1e-7 * np.abs(symmetric).max())


def test_two_bodies_beside_a_wall_are_half_of_four(barge):
    """Before a wall at y = −1.5: with the images of both, moving as images, in waves and their reflection"""
    wall, tug = -1.5, barge.scaled(0.5).rotated(0.4)
    hulls, places = [barge.moved(dy=1.5), tug.moved(dx=1.0, dy=6.0)], [(0.0, 1.5, 0.0), (1.0, 6.0, 0.0)]
    bodies = [Body(name, place) for name, place in zip("ab", places, strict=True)]
    images = [replace(h, points=h.points * [1, -1, 1] + [0, 2 * wall, 0]).flipped() for h in hulls]
    behind = [Body(f"{b.name}_image", (b.rotation_center[0], 2 * wall - b.rotation_center[1], 0.0)) for b in bodies]
    four = solved([*hulls, *images], [*bodies, *behind], headings=(0.7, -0.7))
    two = solved(hulls, bodies, headings=(0.7,), wall=wall)
    for name in ("added_mass", "radiation_damping"):
        whole = four[name][:12, :12] + four[name][:12, 12:] * np.tile(MIRRORED, 2)
        assert two[name] == pytest.approx(whole, abs=1e-6 * np.abs(whole).max())
    from hakobune.bem.waves import wavenumber

    k = float(wavenumber(1.1, 9.0, 9.80665))
    reflected = four["excitation_force"][1] * np.exp(2j * k * np.sin(0.7) * wall)  # the crest at the wall at once
    whole = (four["excitation_force"][0] + reflected)[:12]
    assert two["excitation_force"][0] == pytest.approx(whole, abs=1e-6 * np.abs(whole).max())


def test_what_is_fixed_scatters_and_does_not_move(pair, barge):
    """Forces, and those of the motions of the other body, are the same; the other moves as if the matrices of the
    fixed one were not there"""
    hulls, (moved, held), found = pair
    still = hydrostatics(barge, (0, 0, 0.1))
    M, C = np.zeros((2, 12, 12))
    M[:6, :6] = inertia_matrix(still.mass, (0, 0, 0.1), (1.4, 2.5, 2.5), (0, 0, 0.2))
    C[:6, :6] = still.stiffness
    matrices = {"inertia_matrix": M[:, :6], "hydrostatic_stiffness": C[:, :6]}
    fixed = solved(hulls, [moved, held._replace(fixed=True)], FIRST | {"rao"}, **matrices)
    assert np.allclose(fixed["added_mass"], found["added_mass"][:, :6], rtol=1e-10)
    assert np.allclose(fixed["excitation_force"], found["excitation_force"], rtol=1e-10)
    A, B, F = (fixed[name] for name in ("added_mass", "radiation_damping", "excitation_force"))
    dynamic = -(1.1**2) * (M[:6, :6] + A[:6]) - 1.1j * B[:6] + C[:6, :6]
    assert fixed["rao"] == pytest.approx(np.linalg.solve(dynamic, F[:, :6].T).T, rel=1e-9)


def test_the_drift_of_each_adds_up_to_that_of_the_far_field():
    """Pressure on the hulls and momentum of the waves far away.  Of 160, 300 and 500 panels a body the forces are 7,
    0.7 and 0.1 % apart, the moments 14, 4 and 1 % of a metre of arm"""
    half = with_symmetry(box(8.0, 4.0, 1.5, panels=160), "y")
    hulls = [half.moved(dx=6.0), half.moved(dx=-6.0)]
    bodies = [Body("here", (6.0, 0, 0)), Body("there", (-6.0, 0, 0.1))]
    M, C = np.zeros((2, 12, 12))
    for i, body in enumerate(bodies):
        own, center = slice(6 * i, 6 * i + 6), (0, 0, body.rotation_center[2])
        still = hydrostatics(half, (0, 0, 0.1), rotation_center=center)
        M[own, own], C[own, own] = inertia_matrix(still.mass, (0, 0, 0.1), (1.4, 2.5, 2.5), center), still.stiffness
    names = {"drift_force", "drift_force_fixed", "body_drift_force", "body_drift_force_fixed"}
    found = solved(hulls, bodies, names, omega=1.6, headings=[0.7], inertia_matrix=M, hydrostatic_stiffness=C)
    for each, whole in (("body_drift_force_fixed", "drift_force_fixed"), ("body_drift_force", "drift_force")):
        size = np.abs(found[each][..., :2]).max()
        gap = np.abs(sum_about_origin(found[each], bodies) - found[whole])
        assert gap[0, :2].max() < 0.1 * size and gap[0, 2] < 0.2 * size


def test_a_list_of_one_has_the_drift_by_pressure_of_one(barge):
    from hakobune.bem.methods.near_field import near_field_drift

    still = hydrostatics(barge, (0, 0, 0.1), rotation_center=(0.5, 0, 0))
    matrices = {"inertia_matrix": inertia_matrix(still.mass, (0, 0, 0.1), (1.4, 2.5, 2.5), (0.5, 0, 0))}
    matrices["hydrostatic_stiffness"] = still.stiffness
    alone = PanelProblem(barge, None, depth=9.0, rotation_center=(0.5, 0, 0), **matrices)
    one = near_field_drift(alone.prepared().run(1.3, [0.4], {"drift_force"}, None, None), True)
    found = solved([barge], [Body("it", (0.5, 0, 0))], {"body_drift_force"}, omega=1.3, headings=[0.4], **matrices)
    assert found["body_drift_force"][0] == pytest.approx(one, rel=1e-9)


def test_drift_of_each_of_two_bodies_of_which_one_bends():
    """Together that of the far field, which knows nothing of the hulls; too stiff to bend, that of the rigid body"""
    long, held = box(20.0, 4.0, 1.5, panels=140).whole(), box(8.0, 4.0, 2.0, panels=80).whole()
    hulls = [long.moved(dy=4.0), held.moved(dy=-4.0)]
    bodies = (Body("long", (0.0, 4.0, 0.0)), Body("held", (0.0, -4.0, 0.0), 0.0, True, (0.0, -4.0)))
    still = hydrostatics(long, (0, 0, 0.0))
    M, C = np.zeros((2, 13, 13))
    M[:6, :6], C[:6, :6] = inertia_matrix(still.mass, (0, 0, 0.0), (1.4, 6.0, 6.0), (0, 0, 0.0)), still.stiffness

    def drift(EI):
        beam = Beam("vertical bending", 1, -10.0, 10.0, 0.0, EI, still.mass / 20)
        M[12, 12], C[12, 12] = beam.mass, beam.stiffness + 1025 * 9.80665 * 20.0
        own = [*range(6), 12]
        matrices = {"inertia_matrix": M[:, own], "hydrostatic_stiffness": C[:, own]}
        return solved(hulls, bodies, {"drift_force", "body_drift_force", "rao"}, 1.4, [0.4],
                      modes=(Mode("bending", False, beam, 0, (0.0, 4.0)),), **matrices)  # fmt: skip

    soft, stiff = drift(3e6), drift(1e18)
    whole, each = soft["drift_force"][0], sum_about_origin(soft["body_drift_force"][0], bodies)
    assert abs(soft["rao"][0, 6]) > 0.3 and np.abs(whole - stiff["drift_force"][0]).max() > 0.2 * np.abs(whole).max()
    assert each == pytest.approx(whole, abs=0.03 * np.abs(whole).max())
    matrices = {"inertia_matrix": M[:12, :6], "hydrostatic_stiffness": C[:12, :6]}
    rigid = solved(hulls, bodies, {"body_drift_force"}, 1.4, [0.4], **matrices)["body_drift_force"]
    assert stiff["body_drift_force"] == pytest.approx(rigid, abs=5e-3 * np.abs(rigid).max())


def test_both_limits_of_the_frequency_over_all_motions(pair):
    """Symmetric; at infinity positive, as kinetic energy is; at zero in finite depth without bound between motions that
    displace water, of either body"""
    hulls, bodies, _ = pair
    prepared = PanelProblem(assembled(hulls), None, depth=9.0, bodies=tuple(bodies)).prepared()
    high, low = (prepared.added_mass_limit(which) for which in ("infinity", "zero"))
    assert high == pytest.approx(high.T, abs=0.01 * np.abs(high).max()) and np.linalg.eigvalsh(high + high.T)[0] > 0
    assert np.isposinf(low[np.ix_([2, 8], [2, 8])]).all() and np.isfinite(low[0]).all()


def test_far_apart_each_is_as_alone(barge):
    """Their waves fall as 1/√r: at 200 lengths the forces of the other are less than 2 % of its own"""
    alone = solve_frequency(PanelProblem(barge, None, depth=9.0).prepared(), 1.1, [0.0], FIRST)
    two = solved([barge, barge.moved(dx=1600.0)], [Body("a"), Body("b", (1600.0, 0, 0))], headings=[0.0])
    for own in (slice(0, 6), slice(6, 12)):
        size = np.abs(alone["added_mass"]).max()
        assert two["added_mass"][own, own] == pytest.approx(alone["added_mass"], abs=0.02 * size)
