"""What `hakobune qtf` says of forces of pairs that are made up: root mean squares, units, errors, limits."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.pipelines.qtf import question, report, result, running
from hakobune.pipelines.qtf.result import result_of

OMEGA = np.array([0.4, 0.5, 0.6])


def pairs(value, d=2, modes=6):
    """(d, n, m, m, 6) of pairs: there is none where ω + Ω lies beyond the band"""
    made = np.full((d, len(OMEGA), 1, 1, modes), complex(value))
    for m in range(d):
        made[m, len(OMEGA) - m :] = np.nan
    return made


def forces(kind=DIFFERENCE, squares=4e3, bound=3e3, body=2e3, surface=None, added=None, d=2):
    parts = {"squares": pairs(squares, d), "bound_wave": pairs(bound * 1j, d), "body": pairs(body, d)}
    total = sum(parts.values()) + (0 if surface is None else pairs(surface, d))
    frequency = np.array([0.0, 0.1, 0.2][:d]) if kind is DIFFERENCE else 0.8 + 0.1 * np.arange(d)
    return SimpleNamespace(omega=OMEGA, frequency=frequency, headings=np.array([math.pi]), kind=kind, total=total,
                           added=added, surface=None if surface is None else pairs(surface, d), **parts)  # fmt: skip


def stored(made, share=0.031, errors=None, method="panel", held=True):
    words, held = [name.lower() for name in DOFS], SimpleNamespace(name="", floats=held)
    known = {"share": share, "errors": errors, "method": method, "names": DOFS, "words": words}
    return SimpleNamespace(forces=made, held=held, **known)


def table(forces, **more):
    """{(heading, motion, rad/s): {part: root mean square}} of the result"""
    made = result_of(stored(forces, **more), None)
    parts = {name.removeprefix("force."): q for name, q in made.quantities.items() if name.startswith("force.")}
    labels = made.labels["force"].values.tolist()
    return {label: {part: q.values[i] for part, q in parts.items()} for i, label in enumerate(labels)}, made


@pytest.fixture
def unread(monkeypatch):
    monkeypatch.setattr(result, "provenance", lambda **_: None)


def test_rows_are_root_mean_squares_with_each_part_added(unread):
    """Newman 4; with the bound wave |4 + 3i| = 5; squares in its place the same; with the body |6 + 3i|"""
    rows, made = table(forces())
    assert [label for label in rows if "surge" in label] == ["180° surge, 0 rad/s", "180° surge, 0.1 rad/s"]
    by_hand = {"newman": 4e3, "newman_and_bound_wave": 5e3, "squares_and_bound_wave": 5e3, "body": math.hypot(6e3, 3e3)}
    assert len(rows) == 6  # surge, sway and yaw at two differences
    for row in rows.values():
        assert row == pytest.approx(by_hand)
    assert made.quantities["force.body"].units() == 4 * ("N/m2",) + 2 * ("N m/m2",)
    assert made.notes[0] == ("floating body, 3 frequencies 0.4 to 0.6 rad/s, differences to 0.1 rad/s, 1 heading")
    assert made["surface_share"] == 0.031
    assert made.notes[-1] == (
        "left out: the free-surface forcing around the body (its size, estimated from few pairs: 3.1 % of the force "
        "in surge and sway); --level full includes it"
    )
    assert "no estimated error" in made.notes[-2]


def test_no_level_is_named_where_none_includes_the_surface(unread):
    """A hull of several columns has no share: its waterline is no single curve"""
    _, made = table(forces(), share=None)
    assert made.notes[-1] == (
        "left out: the free-surface forcing around the body, of unknown size: it needs one closed waterline, so no "
        "level includes it here"
    )


def test_a_root_mean_square_is_of_the_pairs_that_there_are(unread):
    """Of squares 3, 4 and 5 and no other part: √(50/3) on the diagonal; two pairs a step apart: √(25/2)"""
    made = forces(squares=0.0, bound=0.0, body=0.0)
    made.squares[0, :, 0, 0, 0], made.squares[1, :2, 0, 0, 0] = [3.0, 4.0, 5.0], [3.0, 4.0]
    made.total[...] = made.squares
    rows, _ = table(made)
    assert rows["180° surge, 0 rad/s"]["body"] == pytest.approx(math.sqrt(50 / 3))
    assert rows["180° surge, 0.1 rad/s"]["body"] == pytest.approx(math.sqrt(25 / 2))


def test_the_surface_is_a_column_and_errors_are_shares(unread):
    """500 of |7 + 3i| thousand"""
    rows, made = table(forces(surface=1e3), errors=pairs(500.0), method="contour")
    assert all(row["surface"] == pytest.approx(1e3 * math.hypot(7, 3)) for row in rows.values())
    whole = 100 * 500 / (1e3 * math.hypot(7, 3))
    assert (
        f"estimated error of the contour method, over the root mean square of the force: surge {whole:.3g} %"
        in (made.notes[-2])
    )
    assert made.notes[-1] == (
        "the free-surface forcing around the body is 3.1 % of the force in surge and sway, root mean square"
    )


@pytest.mark.parametrize("gap, told", [(0.049, False), (0.051, True)])
def test_mean_drift_by_pressure_is_within_a_twentieth_of_the_largest(unread, gap, told):
    added = np.zeros((3, 1, 1, 6))
    added[1, 0, 0, 1] = gap * 4e3
    _, made = table(forces(added=added))
    assert len(made.fails) == told
    assert (
        not told
        or ("mean drift by pressure differs from the far-field drift by 5.1 % of the largest, limit") in made.fails[0]
    )
    assert made["drift_apart"] == pytest.approx(gap)
    assert f"the drift by pressure differs from it by {100 * gap:.3g} % of the largest" in made.notes[1]


def test_sums_are_root_mean_squares_over_their_pairs(unread):
    """|4|, |4 + 3i|, |6 + 3i| kN/m²; no pressure is judged"""
    rows, made = table(forces(SUM), errors=pairs(300.0))
    assert len(rows) == 12 and made.fails == () and "sums to 0.9 rad/s" in made.notes[0]
    for row in rows.values():
        assert row == pytest.approx({"squares": 4e3, "bound_wave": 5e3, "body": math.hypot(6e3, 3e3)})
    share = 100 * 300 / (1e3 * math.hypot(6, 3))
    assert f"of the largest force and moment: surge {share:.3g} %" in made.notes[-2]
    assert made.notes[-1].endswith(
        "left out: the free-surface forcing around the body, a large part of "
        "sum-frequency forces; --level full includes it"
    )


def test_newmans_rule_is_the_signed_root_of_the_product_of_the_diagonal():
    """−√(1 · 4) of two that are both against the waves, 0 of two of other signs"""
    made = forces()
    made.squares[0, :, 0, 0, 0] = [-1.0, -4.0, 9.0]
    rule = report.newman(made, 0, 0)
    assert rule[0] == pytest.approx([-1.0, -4.0, 9.0]) and rule[1, :2] == pytest.approx([-2.0, 0.0])
    assert np.isnan(rule[1, 2])


def test_the_highest_sum_is_that_of_a_wave_three_panels_long():
    """k = 2π/3 of the largest panel; ω² = gk tanh kh"""
    mesh = SimpleNamespace(sizes=np.array([1.0, 2.5]))
    k = 2 * math.pi / 7.5
    assert question.carried_by(mesh, 4.0, 9.8) == pytest.approx(math.sqrt(9.8 * k * math.tanh(4 * k)))
    assert question.carried_by(mesh, math.inf, 9.8) == pytest.approx(math.sqrt(9.8 * k))


SEVEN = np.linspace(0.4, 1.0, 7)


def database(low=0.3, high=1.2):
    return SimpleNamespace(omega=np.linspace(low, high, 10), wave_direction=np.array([0.0, math.pi]), path="box.h5",
                           mesh=SimpleNamespace(sizes=np.array([3.0])), water_depth=20.0, gravity=9.8)  # fmt: skip


def test_differences_go_to_two_fifths_of_the_mean_of_the_band_by_default():
    omega, headings, most = question.waves_of(database(), SEVEN, None, None)
    assert omega == pytest.approx(np.linspace(0.4, 1.0, 7)) and headings == pytest.approx([0.0, math.pi])
    assert most == pytest.approx(0.4 * 0.7)
    assert question.waves_of(database(), SEVEN, np.radians([0, 90]), 9.0)[2] == pytest.approx(
        0.6
    )  # the band is no wider
    assert question.waves_of(database(), SEVEN, np.radians([0, 90, 360]), 0.2)[1] == pytest.approx([0.0, math.pi / 2])


def test_sums_lie_between_twice_the_lowest_and_the_highest_frequency():
    _, _, most = question.waves_and_sums_of(database(), SEVEN, None, 1.5)
    assert most == 1.5 and question.waves_and_sums_of(database(), SEVEN, None, 9.0)[2] == pytest.approx(2.0)
    with pytest.raises(ValueError, match=r"--highest is 0\.79; allowed: 0\.8 rad/s \(twice the lowest"):
        question.waves_and_sums_of(database(), SEVEN, None, 0.79)
    assert question.waves_and_sums_of(database(), SEVEN, None, 0.8)[2] == 0.8


@pytest.mark.parametrize("headings, good", [(15, True), (16, False)])
def test_waves_of_a_question_fit_into_memory(headings, good):
    """100 frequencies with up to 15 headings are 1500"""
    words = np.radians(20.0 * np.arange(headings))
    if good:
        question.waves_of(database(), np.linspace(0.4, 1.0, 100), words, None)
        return
    with pytest.raises(ValueError, match="100 frequencies and 16 headings are requested; allowed: 1500 waves"):
        question.waves_of(database(), np.linspace(0.4, 1.0, 100), words, None)


@pytest.mark.parametrize("share, level, adds", [(0.051, "auto", True), (0.049, "auto", False), (None, "auto", False),
                                                (0.0, "full", True), (1.0, "body", False)])  # fmt: skip
def test_the_surface_is_added_where_it_is_a_twentieth_or_asked_for(share, level, adds):
    one = question.Question(OMEGA, np.zeros(1), 0.1, SimpleNamespace(name="", floats=True), level, "auto", True)
    assert one.adds_surface(share) is adds


def diagonal(squares, added):
    """Two headings, whose own pairs alone count; the moment does not"""
    made = np.zeros((2, 3, 2, 2, 6), complex)
    made[0, :, 0, 0, 0], made[0, :, 1, 1, 1], made[0, :, 0, 1, 0] = squares, -squares / 2, 100 * squares
    made[1, :, 0, 0, 0] = 50 * squares
    more = np.zeros((3, 2, 2, 6), complex)
    more[1, 0, 0, 0], more[2, 1, 1, 1], more[:, 0, 1, 0], more[..., 5] = added / 2, -added, 9e9, 9e9
    return SimpleNamespace(squares=made, added=more, headings=np.zeros(2), kind=DIFFERENCE)


@pytest.mark.parametrize("share", [0.05, 0.2, 0.5])
def test_the_gap_of_pressure_and_far_field_is_of_the_largest_mean_drift(share):
    assert report.diagonal_gap(diagonal(4e3, share * 4e3)) == pytest.approx(share)
    one = diagonal(4e3, 1.0)
    one.added = None
    assert report.diagonal_gap(one) is None


def test_newman_s_force_is_the_signed_root_of_two_drifts():
    """Drifts 1, 4, 9: √(1·4) = 2, √(4·9) = 6; of unlike signs nothing, of both negative −2"""
    squares = np.zeros((2, 3, 1, 1, 6), complex)
    squares[0, :, 0, 0, 0], squares[0, :, 0, 0, 1] = [1.0, 4.0, 9.0], [-1.0, -4.0, 9.0]
    made = SimpleNamespace(squares=squares, frequency=np.array([0.0, 0.1]))
    surge, sway = report.newman(made, 0, 0), report.newman(made, 1, 0)
    assert surge[0] == pytest.approx([1, 4, 9]) and surge[1, :2] == pytest.approx([2, 6]) and np.isnan(surge[1, 2])
    assert sway[0] == pytest.approx([-1, -4, 9]) and sway[1, :2] == pytest.approx([-2, 0])


@pytest.mark.parametrize("changed", ["omega", "headings", "held", "method", "coarser", None])
def test_stored_forces_answer_a_question_of_the_same_waves_body_and_method_alone(monkeypatch, changed):
    there = SimpleNamespace(
        forces=SimpleNamespace(omega=np.array([0.4, 0.5]), headings=np.array([0.0, 1.0])), method="panel",
        held=SimpleNamespace(same_as=lambda other: other == "held"), coarser=None,
    )  # fmt: skip
    asked = SimpleNamespace(kind=DIFFERENCE, omega=np.array([0.4, 0.5]), headings=np.array([0.0, 1.0]), held="held")
    body = SimpleNamespace(method="panel", rough=None)
    for of, key, value in ((asked, "omega", np.array([0.4, 0.6])), (asked, "headings", np.array([0.0, 2.0])),
                           (asked, "held", "free"), (body, "method", "contour")):  # fmt: skip
        if changed == key:
            setattr(of, key, value)
    if changed == "coarser":
        body.rough = "a coarser mesh"
    monkeypatch.setattr(running, "read_forces", lambda db, kind: there)
    assert running._of_same_waves(None, asked, body) is (there if changed is None else None)


@pytest.mark.parametrize(
    ("carried", "says"), [(0.6, None), (0.55, "171 m long (0.6 rad/s), and panels are up to 4.5 m")]
)
def test_panels_that_carry_the_waves_and_others_have_their_way_out(monkeypatch, carried, says):
    """λ = 2πg/ω² in deep water: 171 m at 0.6 rad/s"""
    monkeypatch.setattr(report, "_carried", lambda db: carried)
    flat = np.zeros((1, 4, 3)) + [0.0, 1.0, 2.0]
    mesh = SimpleNamespace(sizes=np.array([3.0, 4.5]), vertices=flat, flat_vertices=flat)
    db = SimpleNamespace(mesh=mesh, water_depth=np.inf, gravity=9.81)
    told = report._smaller_panels(SimpleNamespace(omega=OMEGA), db)
    assert told == "the difference falls with more panels" if says is None else says in told
    assert says is None or "up to 0.55 rad/s" in told
    assert report._smaller_panels(SimpleNamespace(omega=OMEGA), None) == "the difference falls with more panels"
