"""Two bodies on springs to anchors and to each other: offsets, periods and tensions of a chain of two masses."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader
from hakobune.bem.hinges import Link
from hakobune.bem.modes import Body
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.moored_body import Leg, moored_bodies
from hakobune.mooring.studies.conditions import Conditions, ExposedBox, Waves
from hakobune.mooring.studies.multi_point import multi_point

MASS, ADDED, K, BETWEEN = 2e6, 1e6, 4e5, 3e5  # kg, kg, N/m to the anchors of each end and between
OMEGA, HEADINGS = np.array([0.2, 0.5, 0.8, 1.1]), np.array([0.0])
BODIES = (Body("a", (0.0, 0.0, 0.0)), Body("quay", (60.0, 0.0, 0.0), 0.0, True, (60.0, 0.0)),
          Body("b", (30.0, 0.0, 0.0), np.pi, False, (30.0, 0.0)))  # fmt: skip
INERTIA = MASS * np.diag([1, 1, 1, 9.0, 36.0, 36.0])
RESTORED = np.diag([0, 0, 1e6, 3e7, 3e7, 0.0])
RAO = np.zeros(12, complex)
RAO[[0, 6]] = 0.2, 0.3
RAO[[3, 9]] = 1e-9
DRIFT = np.array([[2e4, 0, 0], [7e3, 0, 0], [-5e4, 0, 0]])  # b heads against the waves: 5e4 N along them
BOX = ExposedBox(20.0, 10.0, 5.0, 3.0)


def everywhere(value):
    return np.broadcast_to(value, (4, *np.shape(value))).copy()


def database():
    twice = np.kron(np.eye(2), INERTIA)
    stored = {"added_mass": everywhere(ADDED / MASS * twice), "radiation_damping": everywhere(1e-3 * twice),
              "excitation_force": everywhere(np.ones((1, 12), complex)), "rao": everywhere(RAO[None]),
              "body_drift_force": everywhere(DRIFT[None]), "drift_force": everywhere([[7.7e4, 0, 0]])}  # fmt: skip
    plans = [np.array([[x + 10.0, 5.0], [x - 10.0, -5.0]]) for x in (0.0, 30.0)]
    between = Between(OMEGA, stored, 20.0, 9.81, HEADINGS, np.zeros(1), np.concatenate(plans), outlines=tuple(plans))
    water = {"density": 1025.0, "gravity": 9.81, "water_depth": 20.0}
    reader = Reader(
        between, 1025.0, np.zeros(3), twice, np.kron(np.eye(2), RESTORED), np.zeros((12, 12)), bodies=BODIES
    )
    return SimpleNamespace(bodies=BODIES, bodies_reader=reader, inertia_matrix=twice, has_viscous_motions=False,
                           hydrostatic_stiffness=np.zeros((18, 12)), rotation_center=np.zeros(3), **water)  # fmt: skip


def spring(name, anchor, fairlead, body, stiffness, to="", slack=1.0):
    """A Leg whose line pulls from the start, in proportion to how much longer it is than at `slack` of its way"""
    away = float(np.linalg.norm(np.subtract(anchor, fairlead)))
    pull = pull_of_points(name, [0.0, 100.0], [0.0, 100.0 * stiffness])
    return Leg(Hawser(name, pull, slack * away, "", ""), anchor, fairlead, body, to)


LEGS = [  # each pulls with 2 MN at rest
    spring("west", (-110.0, 0.0, 0.0), (-10.0, 0.0, 0.0), "a", K, slack=0.95),
    spring("tie", (10.0, 0.0, 0.0), (20.0, 0.0, 0.0), "b", BETWEEN, "a", 1 / 3),
    spring("east", (140.0, 0.0, 0.0), (40.0, 0.0, 0.0), "b", K, slack=0.95),
]


def system(legs=LEGS):
    moving = {body.name: (body.rotation_center, body.heading) for body in BODIES if not body.fixed}
    return moored_bodies(legs, moving, 20.0, 1025.0, 9.81)


@pytest.fixture(scope="module")
def found():
    waves = Conditions(waves=Waves(2.0, 2 * np.pi / 0.5, 0.0), method="regular_wave")
    return multi_point(database(), system(), {"a": BOX, "b": BOX}, waves)


def test_periods_in_surge_are_those_of_two_masses_on_three_springs(found):
    """m λ = K + k ∓ k: both the one way, and against each other, whichever way b heads"""
    surge = sorted(found.at_rest.period[[0, 6]])
    exact = 2 * np.pi * np.sqrt((MASS + ADDED) / np.array([K + 2 * BETWEEN, K]))
    assert surge == pytest.approx(exact, rel=1e-9)
    assert found.at_rest.names[:6] == tuple(f"a__{d}" for d in ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"))


def test_steady_offsets_are_those_of_the_chain(found):
    """Drift of each along the waves, (½H)² = 1 m²:  K + k, −k; −k, K + k"""
    assert found.loads["drift"][[0, 6]] == pytest.approx([2e4, 5e4], rel=1e-12)
    exact = np.linalg.solve([[K + BETWEEN, -BETWEEN], [-BETWEEN, K + BETWEEN]], [2e4, 5e4])
    assert found.displacement[[0, 3]] == pytest.approx(exact, rel=1e-9)
    assert found.displacement[[1, 2, 4, 5]] == pytest.approx(np.zeros(4), abs=1e-9)
    steady, rest = (state.lines.tension_b for state in (found.equilibrium, found.rest))
    stretched = [exact[0], exact[1] - exact[0], -exact[1]]
    assert steady - rest == pytest.approx(np.array([K, BETWEEN, K]) * stretched, rel=1e-8)


def test_a_line_between_two_is_tightened_by_both(found):
    """|X| = 0.2 and 0.3 m/m in waves of 1 m"""
    assert found.outward == pytest.approx([0.2, 0.5, 0.3]) and found.upward == pytest.approx(np.zeros(3), abs=1e-6)
    steady = found.equilibrium.lines.tension_b
    assert found.tension - steady == pytest.approx([0.2 * K, 0.5 * BETWEEN, 0.3 * K], rel=1e-6)


def test_a_line_from_a_body_to_itself_is_refused():
    own = spring("own", (5.0, 0.0, 0.0), (-5.0, 0.0, 0.0), "a", K, "a", 0.9)
    with pytest.raises(ValueError, match="line own runs from a to itself; allowed: to an anchor or another body"):
        multi_point(database(), system([*LEGS, own]), {"a": BOX, "b": BOX}, Conditions())


def test_drift_of_each_on_a_current_that_carries_the_waves_is_refused():
    from hakobune.mooring.studies.conditions import Current

    waves = Conditions(current=Current(0.5, 0.0), waves=Waves(2.0, 12.0, 0.0), method="regular_wave")
    with pytest.raises(ValueError, match='known only for waves in still water; give waves = "still"'):
        multi_point(database(), system(), {"a": BOX, "b": BOX}, waves)


def test_a_hinge_carries_its_share_of_the_weight_of_chains():
    """Two bodies with a pin in the middle, a weight W hung 10 m west of the first; down and east end down are positive

    c z₁ = W − F,  r θ₁ = −10 W − 15 F,  c z₂ = F,  r θ₂ = −15 F,  z₁ + 15 θ₁ = z₂ − 15 θ₂
    """
    weight, c, r, k = 5e4, 1e6, 3e7, 5e3
    west, east = (leg._replace(line=replace(leg.line, length=99.95)) for leg in LEGS[::2])  # 20 kN
    hung = spring("hung", (-10.0, 0.0, -20.0), (-10.0, 0.0, 0.0), "a", k, slack=0.5)
    made = database()
    made.bodies_reader = made.bodies_reader.linked([Link("pin", ("a", "b"), (15.0, 0.0, 0.0))])
    found = multi_point(
        made, system([west, hung, east]), {"a": BOX, "b": BOX}, Conditions(), body=made.bodies_reader
    )  # fmt: skip
    rows = np.array([[c, 0, 0, 0, 1], [0, r, 0, 0, 15], [0, 0, c, 0, -1], [0, 0, 0, r, 15], [1, 15, -1, 15, 0]], float)
    rows[:2, :2] += k * np.array([[1, -10], [-10, 100]])  # the spring that it hangs on gives way
    force = np.linalg.solve(rows, [weight, -10 * weight, 0, 0, 0])[4]
    assert abs(force) > 0.1 * weight and found.held[0, 0, 2] == pytest.approx(-force, rel=0.02)
    assert found.held[1] == pytest.approx(found.held[0], abs=1e-3 * weight)
