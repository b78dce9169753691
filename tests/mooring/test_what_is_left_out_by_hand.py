"""What calculations leave out, and what they do then: by made-up bodies, forces and seas whose answers are known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.reader import BetweenError
from hakobune.mooring.breakwater import anchors as of_anchors
from hakobune.mooring.dolphins import earthquake
from hakobune.mooring.lines.system import equilibrium
from hakobune.mooring.motion import given_forces
from hakobune.mooring.response import bound_wave_drift, drift, points, sea_state, viscous
from hakobune.mooring.single_point import equilibria, rings
from hakobune.mooring.studies.breakwater import pareto
from hakobune.mooring.studies.breakwater.breakwater import BreakwaterError

# ------------------------------------------------------------------ single points


def loads_of(rows):
    return SimpleNamespace(at_rest=lambda psi: np.array([rows(angle) for angle in np.atleast_1d(psi)]))


@pytest.mark.parametrize("rows, says", [
    (lambda psi: (0.0, 0.0, 5.0), "exert no force"),
    (lambda psi: (7.0, 0.0, 0.0), "do not turn the body about its attachment"),
    (lambda psi: (0.0, 2.0, 2.0 * 40.0), "do not turn the body about its attachment"),
    (lambda psi: (0.0, 2.0, -2.0 * 40.0), "push the body onto its mooring"),
    (lambda psi: (0.0, 2.0 * (psi == 0), 0.0), "push the body onto its mooring"),
])  # fmt: skip
def test_why_nothing_is_in_equilibrium_is_no_force_no_moment_or_a_push(rows, says):
    """A force of 2 N abeam at the attachment, 40 m ahead, has the moment 80 N m about the origin and none about it"""
    point = SimpleNamespace(loads=loads_of(rows), apex=np.array([40.0, 0.0]))
    assert says in equilibria._why_none(point)


TWO = SimpleNamespace(apex=np.array([13.0, 0.0]), ends=np.array([[10.0, 4.0], [10.0, -4.0]]),
                      lengths=np.array([5.0, 5.0]))  # fmt: skip
ONE = SimpleNamespace(ends=np.array([[10.0, 0.0]]), lengths=np.array([20.0]))


@pytest.mark.parametrize("force, tension", [
    ((-60.0, 0.0, 0.0), (50.0, 50.0)), ((-60.0, -80.0, 0.0), (0.0, 100.0)), ((-60.0, 80.0, 9.0), (100.0, 0.0)),
    ((-60.0, -40.0, 9.0), (25.0, 75.0)), ((-60.0, -90.0, 0.0), None), ((60.0, 0.0, 0.0), None), ((0.0, 0.0, 3.0), None),
])  # fmt: skip
def test_hawsers_to_one_point_share_a_force_along_them(force, tension):
    """Triangles of 3, 4 and 5 m: along (3, ∓4)/5 from the bow; none that would have to push"""
    found = equilibria._tensions(TWO, np.array(force), TWO.apex, 0.0, -1)
    assert found is None if tension is None else found == pytest.approx(tension, abs=1e-9)


@pytest.mark.parametrize(
    "force, slack", [((-3.0, -4.0, 0.0), True), ((-3.0, 4.0, 0.0), False), ((-5.0, 0.0, 0.0), False)]
)
def test_a_hawser_alone_carries_a_force_if_the_other_is_slack(force, slack):
    """The buoy 5 m from (10, 4) against the force: at (13, 8), 12.4 m from the other, at (13, 0), 5 m, or (15, 4)"""
    found = equilibria._tensions(TWO, np.array(force), TWO.ends[0], 5.0, 0)
    far = math.hypot(*(TWO.ends[0] - np.array(force[:2]) - TWO.ends[1]))
    assert (far > 5.0) == (force[1] != 4.0)
    assert found is None if far > 5.0 else found == pytest.approx([5.0, 0.0])
    assert equilibria._tensions(ONE, np.array([3.0, -4.0, 0.0]), ONE.ends[0], 20.0, 0).tolist() == [5.0]


@pytest.mark.parametrize("function, wanted", [
    (lambda x: np.sin(x - 0.3), [0.3]), (lambda x: x - 0.3 - 1e-9, [0.3 + 1e-9]),
    (lambda x: (x - 0.31) ** 3, [0.31]), (lambda x: (x - 0.3) ** 2 + 1e-3, []), (lambda x: 1.0 + 0 * x, []),
])  # fmt: skip
def test_a_zero_near_that_of_a_spline_is_where_the_sign_changes(function, wanted):
    found = rings._near(function, lambda x: float(function(np.array(x))), 0.3, 0.1)
    assert found == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize("level, wanted", [(1e-4, (0.49, 0.51)), (-1e-4, ()), (2.0, ())])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_beside_a_crest_lie_two_zeros_none_or_others_that_are_found_elsewhere(level, wanted, sign):
    """±((x − 0.5)² − 1e-4): zeros 0.01 on either side of 0.5; above, or below at both ends, none"""
    found = rings._beside_crest(lambda x: sign * ((x - 0.5) ** 2 - level), 0.503, 0.1)
    assert np.sort(found) == pytest.approx(wanted, abs=1e-9)
    assert rings._beside_crest(lambda x: sign * (x - 0.5), 0.5, 0.1) == []


@pytest.mark.parametrize("found, wanted", [
    ([], []), ([1.0], [1.0]), ([2.0, 1.0, 1.0 + 1e-14], [1.0, 2.0]), ([0.0, 1.0, 2 * np.pi - 1e-14], [0.0, 1.0]),
])  # fmt: skip
def test_angles_equal_to_rounding_are_one_round_the_circle_too(found, wanted):
    assert np.sort(np.mod(rings._distinct(np.array(found)) + 1e-9, 2 * np.pi)) == pytest.approx(wanted, abs=1e-8)


# ------------------------------------------------------------------ responses


@pytest.mark.parametrize("covered", [True, False])
def test_drift_is_differentiated_round_the_circle_where_it_is_known_there(covered):
    """D = cos β + ½ sin 2β: D′ = −sin β + cos 2β; elsewhere by differences of what is known"""
    asked = []

    def of(omega, heading, fixed):
        asked.append(len(heading))
        if len(heading) == 72 and not covered:
            raise BetweenError("no waves from behind")
        D = np.cos(heading) + 0.5 * np.sin(2 * heading)
        return np.tile(D[None, :, None], (len(omega), 1, 3)) * omega[:, None, None]

    omega, heading = np.array([1.0, 2.0, 3.0, 4.0]), np.radians([0.0, 5.0, 10.0, 15.0])
    value, over, slope = drift.drift_slopes(SimpleNamespace(drift=of), omega, heading)
    D = np.cos(heading) + 0.5 * np.sin(2 * heading)
    assert value == pytest.approx(np.tile(np.multiply.outer(omega, D)[..., None], 3), rel=1e-9)
    assert over == pytest.approx(np.tile(D[:, None], (4, 1, 3)), rel=1e-9)
    turn = np.multiply.outer(omega, -np.sin(heading) + np.cos(2 * heading))
    assert slope == pytest.approx(np.tile(turn[..., None], 3), rel=1e-10 if covered else 5e-3, abs=5e-3 * (not covered))
    assert asked == ([72] if covered else [72, 12])


def test_a_keel_has_two_corners_and_a_ball_one():
    line = np.array([[0.0, 0, -5], [10.0, 0, -5], [10.0, 0, -5], [3.0, 1.0, -1.0]])
    assert points.corners_of_bottom(line).tolist() == [[0, 0, -5], [10, 0, -5]]
    assert points.corners_of_bottom(np.array([[1.0, 2.0, -5.0], [0.0, 0.0, 0.0]])).tolist() == [[1, 2, -5]]


def test_a_bottom_of_many_corners_has_twelve_of_them_in_order():
    """A polygon of 40 sides: of 40 corners every third or fourth, turning left, all on the circle"""
    angle = 2 * np.pi * np.arange(40) / 40
    ring = np.stack([5 * np.cos(angle), 5 * np.sin(angle), np.full(40, -3.0)], axis=1)
    found = points.corners_of_bottom(np.concatenate([ring, ring * [0.5, 0.5, 1.0], ring * [2.0, 2.0, 0.1]]))
    assert len(found) == 12 and np.hypot(*found[:, :2].T) == pytest.approx(np.full(12, 5.0), rel=1e-5)
    turns = np.diff(np.unwrap(np.arctan2(found[:, 1], found[:, 0])))
    assert np.all(turns > 0) and turns.max() < 2 * np.pi / 9


def test_a_body_without_laws_has_no_viscous_damping_in_regular_waves():
    floating = SimpleNamespace(damping=np.ones((6, 6)))
    reader = SimpleNamespace(viscous=None, floating=lambda: floating)
    body, damping = viscous.in_regular_waves(reader, 0.8, 1.0, 0.0)
    assert body is floating and damping.shape == (6, 6) and not damping.any()


def test_damping_in_regular_waves_is_beside_that_of_the_water_and_the_body(monkeypatch):
    """A = 2ω, radiated 3 and its own 4 N s/m, laws at the amplitude of the waves; the body has what is found"""
    told = {}

    def response(omega, A, B, force, inertia, stiffness, laws):
        told.update(at=(omega, A, B, force, inertia, stiffness), amplitude=laws.wave_amplitude)
        return None, ("found",)

    monkeypatch.setattr(viscous, "linearised_response", response)
    monkeypatch.setattr(viscous, "replace", lambda laws, **changes: SimpleNamespace(**{**vars(laws), **changes}))
    floating = SimpleNamespace(damping=4.0, inertia="M", stiffness="K", coefficients=lambda w: ([2.0 * w[0]], [3.0]),
                               forces=lambda w, b: [[f"F at {w[0]:g} to {b[0]:g}"]],
                               restrained=lambda damping: ("held", damping))  # fmt: skip
    laws = SimpleNamespace(laws={"Roll": "law"}, wave_amplitude=9.0)
    reader = SimpleNamespace(viscous=laws, floating=lambda: floating)
    assert viscous.in_regular_waves(reader, 0.8, 1.5, 0.25) == (("held", "found"), "found")
    assert told == {"at": (0.8, 1.6, 7.0, ["F at 0.8 to 0.25"], "M", "K"), "amplitude": 1.5}


def test_damping_in_waves_on_a_current_is_at_the_frequency_that_is_met(monkeypatch):
    """m₀ = ¼ and m₂ = 1 at the frequencies met: σ = ½, ω₂ = 2; the law is told both, of motions that have one"""
    monkeypatch.setattr(viscous, "frequencies", lambda body, density: np.array([0.5, 1.0]))
    monkeypatch.setattr(viscous, "directions", lambda sea, omega, step: (np.zeros(1), np.ones(1)))
    met = np.array([[0.7], [1.2]])

    def of(omega, at, X, density, weights):
        assert at is met
        return SimpleNamespace(m0=np.array([0.25, 0.0, 0.25]), m2=np.array([1.0, 0.0, 1.0]))

    monkeypatch.setattr(viscous, "moments_met", of)
    body = SimpleNamespace(names=("a", "b", "c"), motions=lambda *_: np.ones((2, 1, 3)), encounter=lambda w, b: met,
                           carrier="current")  # fmt: skip
    monkeypatch.setattr(viscous, "carrier_of_body", lambda body: body.carrier, raising=False)
    law = SimpleNamespace(equivalent=lambda frequency, amplitude: 100 * frequency + amplitude)
    sea = SimpleNamespace(spectrum=SimpleNamespace(density=lambda w: w))
    found = viscous._damping(body, sea, {"a": law, "b": law}, 5.0)
    assert found == pytest.approx([200 + viscous.EQUIVALENT_AMPLITUDE / 2, 0.0, 0.0])


def test_drift_of_each_body_is_left_out_where_it_is_not_known(monkeypatch):
    def unknown(omega, heading):
        raise BetweenError("none")

    given = None, np.ones(2), np.zeros(1), np.ones(1)
    assert sea_state.drift_of_each(SimpleNamespace(bodies=()), *given) is None
    assert sea_state.drift_of_each(SimpleNamespace(bodies=("a", "b"), drift_of_each=unknown), *given) is None
    monkeypatch.setattr(sea_state, "mean_drift", lambda body, sea, omega, drift, weights: (
        drift[0, 0], np.stack([drift[0, 0], 2 * drift[1, 0]])))  # fmt: skip
    rows = np.arange(12.0).reshape(2, 1, 2, 3)
    known = SimpleNamespace(bodies=("a", "b"), drift_of_each=lambda omega, heading: rows)
    assert sea_state.drift_of_each(known, *given) == pytest.approx(2 * rows[0, 0] + 2 * rows[1, 0])


@pytest.mark.parametrize("drift, inertia, known", [(True, "M", True), (False, "M", False), (True, None, False)])
def test_slow_forces_of_bound_waves_are_compared_where_drift_and_inertia_are_known(drift, inertia, known, monkeypatch):
    """Root of ∫ (S_x + S_y) dΔ: 2 and 8 N² s/rad over 0.5 rad/s, by Newman 18: √(10/18)"""
    monkeypatch.setattr(bound_wave_drift, "held_beyond", lambda omega, D, spectrum: (omega, D))
    monkeypatch.setattr(bound_wave_drift, "differences", lambda body: np.linspace(0.0, 0.5, 33))
    monkeypatch.setattr(bound_wave_drift, "force_spectrum_with", lambda bound, spectrum, omega, D, step: (
        np.tile([2.0, 8.0, 99.0], (len(step), 1)) if not D.any() else None))  # fmt: skip
    monkeypatch.setattr(bound_wave_drift, "force_spectrum", lambda spectrum, omega, D, step: (
        np.tile([6.0, 12.0, 99.0], (len(step), 1))))  # fmt: skip
    spectrum = SimpleNamespace(moment=lambda n: 1.0, quantile=lambda p: np.array([0.5, 2.0]))
    body = SimpleNamespace(knows_drift=drift, inertia=inertia, omega=np.array([0.6, 1.8]),
                           drift=lambda omega, heading: np.ones((len(omega), 1, 3)))  # fmt: skip
    found = bound_wave_drift.bound_to_newman(body, SimpleNamespace(spectrum=spectrum, direction=0.0))
    assert found == (pytest.approx(math.sqrt(10 / 18)) if known else None)


def test_forces_that_are_not_given_are_nil_of_every_body():
    total, step = given_forces.sampled((), 10.0, 100.0, 2)
    assert total.shape == (12, 1) and not total.any() and step == 1.0
    one = given_forces.GivenForce(np.linspace(-10.0, 100.0, 56), np.full((56, 6), 3.0), 1)
    total, _ = given_forces.sampled((one, one), 10.0, 100.0, 3)
    assert len(total) == 18 and np.allclose(total[6:12], 6.0) and not total[:6].any() and not total[12:].any()


@pytest.mark.parametrize("value, least", [(0.5, 0.5), ([0.5, 1e-4, 2.0], 1e-4), (1e-3, None), ([1e-3, 2.0], None)])
def test_a_friction_is_a_thousandth_or_more_everywhere(value, least):
    if least is None or np.min(value) >= 1e-3:
        assert np.all(of_anchors.common_sinker(1.0, 0.0, value) == 1 / np.asarray(value))
    else:
        with pytest.raises(ValueError, match=f"friction is {least:g}; allowed: 0.001 or more"):
            of_anchors.common_sinker(1.0, 0.0, value)


# ------------------------------------------------------------------ designs of breakwaters


def made_up(monkeypatch, sea=None, slack=(), stiffness=1.0, greatest=(3.0, 5.0)):
    asked = {}
    made = SimpleNamespace(
        waves=SimpleNamespace(period=np.linspace(4.0, 12.0, 25), height=1.5),
        body="body",
        sea=sea,
        design=("taut", "linear"),
        taut=lambda rise: SimpleNamespace(stiffness=stiffness - rise),
    )
    monkeypatch.setattr(pareto, "tides_of", lambda made, period: asked.update(period=period) or [
        SimpleNamespace(rise=0.0), SimpleNamespace(rise=0.5)])  # fmt: skip
    monkeypatch.setattr(pareto, "pretension_of", lambda made, tides: SimpleNamespace(
        slack=slack, greatest=np.array(greatest)))  # fmt: skip
    monkeypatch.setattr(pareto, "response", lambda made, hold, theory, angle, omega: (
        asked.update(omega=omega, hold=(hold, theory, angle)) or SimpleNamespace(
            transmission=np.array([0.2j, -0.7, 0.3]))))  # fmt: skip
    return (lambda **values: asked.update(values) or made), asked


@pytest.mark.parametrize("few, count", [(True, pareto.FEW_PERIODS), (False, 25)])
def test_a_design_is_judged_by_its_greatest_tension_and_the_largest_wave_behind(few, count, monkeypatch):
    """|K_T| of 0.2, 0.7 and 0.3; trials at ten of 25 periods, both ends with them"""
    changed, asked = made_up(monkeypatch)
    assert pareto.objectives(changed, {"draft": 3.0}, few) == (5.0, 0.7)
    assert asked["draft"] == 3.0 and asked["hold"] == ("taut", "linear", 0.0) and len(asked["period"]) == count
    assert asked["period"][[0, -1]].tolist() == [4.0, 12.0] and asked["omega"] * asked["period"] == pytest.approx(
        2 * math.pi
    )


@pytest.mark.parametrize("more, holds", [
    ({}, True), ({"slack": ("front",)}, False), ({"stiffness": 0.6}, True), ({"stiffness": 0.5}, False),
    ({"greatest": (3.0, np.inf)}, False), ({"greatest": (np.nan, 4.0)}, False),
])  # fmt: skip
def test_a_design_that_slackens_or_falls_over_at_any_tide_does_not_hold(more, holds, monkeypatch):
    changed, _ = made_up(monkeypatch, **more)
    assert (pareto.objectives(changed, {}, False) is not None) == holds


def test_a_design_that_cannot_be_made_does_not_hold():
    def changed(**values):
        raise BreakwaterError("too deep")

    assert pareto.objectives(changed, {"draft": 30.0}, True) is None


@pytest.mark.parametrize("few", [True, False])
def test_behind_a_design_in_a_sea_are_four_deviations_of_what_passes(few, monkeypatch):
    cells = SimpleNamespace(omega="ω", deviation=lambda K: 0.15 * K)
    changed, asked = made_up(monkeypatch, sea=SimpleNamespace(spectrum="S"))
    monkeypatch.setattr(pareto, "equal_cells", lambda spectrum, count: asked.update(cells=count) or cells)
    monkeypatch.setattr(pareto, "ways_of", lambda made, omega, count: asked.update(ways=count) or "ways")
    monkeypatch.setattr(
        pareto,
        "response_in_sea",
        lambda made, hold, theory, rise, omega, amplitude, ways: (
            asked.update(at=(hold, theory, rise, omega, amplitude, ways)) or SimpleNamespace(transmission=0.8)
        ),
    )
    assert pareto.objectives(changed, {}, few) == (5.0, pytest.approx(4 * 0.15 * 0.8))
    assert asked["at"] == ("taut", "linear", 0.0, "ω", 0.75, "ways")
    counts = (pareto.FEW_CELLS, pareto.FEW_WAYS) if few else (pareto.SEA_CELLS, pareto.WAYS)
    assert (asked["cells"], asked["ways"]) == counts


# ------------------------------------------------------------------ searches


@pytest.mark.parametrize("radius", [1e-3, 0.1, 1.0, 2.0, 5.0])
def test_a_step_where_a_stiffness_is_indefinite_solves_an_evenly_stiffer_system_at_its_length(radius):
    """K = Q diag(−2, 1, 4) Qᵀ: s = Q (|λ| + m)⁻¹ Qᵀ r, of the length asked for, or of m = 0 where that is shorter"""
    rng = np.random.default_rng(3)
    Q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    K = np.zeros((4, 4))
    K[:3, :3] = Q @ np.diag([-2.0, 1.0, 4.0]) @ Q.T
    K[3, 3] = 7.0
    residual, moving = np.array([1.0, -2.0, 3.0, 9.0]), np.array([True, True, True, False])
    found = equilibrium._Indefinite(K, residual, np.ones(4), moving).within(radius)
    whole = Q @ (Q.T @ residual[:3] / np.array([2.0, 1.0, 4.0]))
    if radius >= np.linalg.norm(whole):
        assert found == pytest.approx(whole)
    else:
        assert 0.98 * radius <= np.linalg.norm(found) <= radius * (1 + 1e-12)
        along, rest = Q.T @ found, Q.T @ residual[:3]
        assert rest / along - np.array([2.0, 1.0, 4.0]) == pytest.approx(np.full(3, rest[0] / along[0] - 2.0))
    still = equilibrium._Indefinite(K, np.zeros(4), np.ones(4), moving).within(radius)
    assert still.tolist() == [0.0, 0.0, 0.0]


def test_a_scaled_stiffness_is_that_of_the_scaled_freedoms():
    """Freedoms over units of 1 and 10: K/(u uᵀ)"""
    K, unit = np.diag([-2.0, 300.0]), np.array([1.0, 10.0])
    found = equilibrium._Indefinite(K, np.array([1.0, 6.0]), unit, np.array([True, True])).within(100.0)
    assert np.abs(found) == pytest.approx([0.5, 2.0])


@pytest.mark.parametrize("slow", [1.0, 1e-4])
def test_the_frequency_of_a_body_on_a_spring_has_the_added_mass_there(slow):
    """ω² (m + A(ω)) = K with A = ½m (1 + ω²/ω₀²): ω²/ω₀² = x of x (1.5 + ½x) = κ, however slow"""
    floater = SimpleNamespace(mass=2.0, added_mass=0.3, water=lambda omega: (
        np.array([1.0 + (omega / slow) ** 2]), np.zeros(1)))  # fmt: skip
    found = earthquake.natural(floater, 2.0 * slow**2 * 0.8)
    x = -1.5 + math.sqrt(1.5**2 + 2 * 0.8)
    assert found == pytest.approx(slow * math.sqrt(x), rel=1e-6)
