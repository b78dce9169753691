"""How fine the parts of the contour method are, by their fitted laws: functions, modes, tables, and finer bodies."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.contour import one_frequency
from hakobune.bem.contour.accuracy import Accuracy, accuracy, finer
from hakobune.bem.contour.body import ContourBody
from hakobune.bem.contour.modal_sums import ChebyshevNodes
from hakobune.bem.contour.plan import potentials
from hakobune.bem.contour.plan.rectangle import Rectangle
from hakobune.bem.contour.several.bodies import SeveralBodies, beside, near, prepare_several
from hakobune.bem.contour.several.exterior import Place
from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.contour.standing import NoGap, WallProfiles
from hakobune.bem.depth_modes.gap import Gap, rounded


@pytest.mark.parametrize("digits", [1.5, 3.5, 6.0, 7.5])
@pytest.mark.parametrize(
    "draft, gap, scale", [(10.0, 10.0, 25.0), (2.0, 300.0, 8.0), (12.0, 0.3, 5.0), (1.0, 40.0, 9.0)]
)
def test_parts_are_as_fine_as_their_errors_were_measured(digits, draft, gap, scale):
    """The table of the module solved for T, m, q, p and e; three digits of panels and one of the table at least"""
    r, g = gap / min(draft, scale), gap / scale
    high = max(g / 4, 1.0)
    found = accuracy(digits, draft, gap, scale)
    error = lambda T: -8 * (1 + r) ** -0.7 - (T - 1) * (0.8 + 1.7 / (1 + r / 4))  # noqa: E731
    assert error(found.terms) <= -digits + 1e-9 and (found.terms == 1 or error(found.terms - 1) > -digits)
    assert found.modes / 15 == pytest.approx(max(0.7, (digits - 1.5) / 1.2))
    table = (digits - 0.8 + math.log10(g**1.45 * high**1.5)) / 1.15
    assert found.kappa == pytest.approx(max(1.0, table))
    assert found.plan == pytest.approx(max(3.0, (digits - 1.2 + math.log10(high**3.3)) / 1.3))
    assert found.extra == max(1, math.ceil((digits - 2.4) * 1.5)) and found.further == 0 and found.digits == digits
    assert found.smallest == pytest.approx(max(10 ** (-3 - digits), 1e-8) / high)


def test_a_finer_body_has_a_digit_more_in_every_part():
    """One function of the gap more where the next two digits need one; its polynomials to the next step"""
    coarse = accuracy(3.5, 10.0, 10.0, 25.0)
    fine, one, two = finer(coarse, 10.0, 10.0, 25.0), accuracy(4.5, 10, 10, 25), accuracy(5.5, 10, 10, 25)
    assert fine.digits == 4.5 and fine.terms == max(one.terms, min(two.terms, coarse.terms + 1))
    assert fine.kappa == pytest.approx(max(one.kappa, coarse.kappa + 1 / 1.15))
    assert fine.plan == pytest.approx(max(one.plan, coarse.plan + 1 / 1.3))
    assert (fine.extra, fine.further, fine.modes) == (coarse.extra, 1, one.modes)
    least = Accuracy(3.5, 9, 1e-6, 30.0, 7.0, 8.0, 2)  # finer already than the law asks
    better = finer(least, 10.0, 10.0, 25.0)
    assert better.kappa == pytest.approx(7 + 1 / 1.15) and better.plan == pytest.approx(8 + 1 / 1.3)


BOX = prepare_box(30.0, 20.0, 5.0, 12.0, 1e-3)
PILE = prepare_cylinder(4.0, 12.0, 12.0, 1e-3)


def test_a_sharper_body_keeps_a_tenth_of_the_tolerance_and_the_last_has_none():
    for body in (BOX, PILE):
        gap = body.depth - body.draft or 0.01 * body.plan.scale
        sharp = body.sharper
        assert type(sharp) is type(body) and (sharp.draft, sharp.depth) == (body.draft, body.depth)
        assert sharp.accuracy == accuracy(body.accuracy.digits + 1, body.draft, gap, body.plan.scale)
        assert sharp.tolerance == pytest.approx(0.1 * body.tolerance) and sharp.cache == {}
        assert sharp.plan == body.plan.to(sharp.accuracy)
        fine = body.finer
        assert type(fine) is type(body) and fine.accuracy == finer(body.accuracy, body.draft, gap, body.plan.scale)
        assert fine.plan == body.plan.to(fine.accuracy) and fine.draft == body.draft
        assert sharp.sharper.sharper.sharper.tolerance == pytest.approx(1e-4 * body.tolerance)
        assert sharp.sharper.sharper.sharper.sharper is None
    assert prepare_box(30.0, 20.0, 5.0, 12.0, 0.9e-6).sharper is None
    assert prepare_cylinder(4.0, 12.0, 12.0, 0.9e-6).sharper is None
    assert prepare_cylinder(4.0, 12.0, 12.0, 1e-6).sharper is not None


@pytest.mark.parametrize("k", [0.01, 0.5, 3.0])
def test_waves_that_have_decayed_at_the_keel_need_no_functions(k, monkeypatch):
    """Degrees for k or −ln ε over the draft, and for the wavenumber of the table of these"""
    asked = []
    plan = SimpleNamespace(degree=lambda k, tolerance: asked.append((k, tolerance)) or len(asked),
                           table_wavenumber=lambda k: 10 * k)  # fmt: skip
    body = SimpleNamespace(plan=plan, tolerance=1e-3, draft=5.0)
    waves = min(k, np.log(1e3) / 5.0)
    assert one_frequency.degrees(body, k) == (1, 2)
    assert asked == [(pytest.approx(waves), 1e-3), (pytest.approx(10 * waves), 1e-3)]


def test_the_table_reaches_from_the_first_mode_to_where_its_maps_have_their_limit():
    """π/2h to 10^(q/3 + 0.1) times the largest of 1/scale, π/2h and a quarter of the finest function"""
    for finest in (0.0, 9.0):
        plan = SimpleNamespace(scale=10.0, finest=lambda degree, finest=finest: finest)
        made = ContourBody(plan, 5.0, 12.0, Accuracy(3.5, 3, 1e-6, 30.0, 2.4, 3.0, 2))
        nodes = made.nodes((3, 3))
        first = np.pi / 24
        last = 10 ** (2.4 / 3 + 0.1) * max(0.1, first, 0.25 * finest)
        assert (nodes.first, nodes.last) == pytest.approx((first, last))
        assert nodes.count == int(np.ceil(0.8 * 3.9 * np.log(last / first))) + 2
        assert made.nodes((3, 3)) is nodes


def test_equal_resolutions_are_told_by_degrees_and_the_nodes_of_the_contour():
    from hakobune.bem.waves import wavenumber

    for omega in (0.5, 2.5):
        k = float(wavenumber(omega, 12.0, 9.80665))
        degree, top = one_frequency.degrees(BOX, k)
        count = len(BOX.plan.contour(k, degree, BOX.tolerance).weights)
        assert BOX.resolution(omega) == (degree, top, count)
    assert BOX.resolution(0.5) != BOX.resolution(2.5)


def test_counts_of_modes_are_for_the_smallest_length_and_rise_in_steps_of_a_fifth():
    assert [rounded(count) for count in (1.0, 1.1, 1.2, 7.0, 100.0)] == [1, 2, 2, 8, 115]
    gap = Gap(5.0, 12.0, 3)
    least = (8 + 8 * 8) * 12 / 7
    for modes, shortest, k in ((15.0, 4.0, 0.1), (300.0, 4.0, 0.1), (300.0, 99.0, 2.0), (1.0, 9.0, 0.0)):
        wanted = max(modes * 12 / min(7.0, 5.0, shortest), least) + 4 * k * 12
        assert gap.mode_count(k, modes, shortest) == rounded(wanted)
    assert gap.mode_count(0.1, 1.0, 9.0, 2) == rounded((8 + 2 * 8) * 12 / 7 + 4.8)
    assert gap.inner_count(30.0, 2.0) == rounded(max(30 * 3.5, 32 * 9)) == rounded(288)
    assert gap.inner_count(300.0, 2.0) == rounded(1050) and gap.inner_count(300.0, 20.0) == rounded(300)


def test_a_wall_down_to_the_bed_has_its_two_rows_and_no_gap():
    wall, k = NoGap(12.0, 12.0, 0), 0.3
    assert wall.outer_decays.tolist() == [2.0, 2.0] and wall.cosine_moments(np.ones(5)).shape == (0, 5)
    assert wall.mode_count(k, 15.0, 4.0) == rounded(15 * 12 / 4 + 4 * k * 12)
    assert wall.mode_count(k, 15.0) == rounded(15 + 4 * k * 12) and wall.mode_count(k, 2.0) == rounded(8 + 4 * k * 12)
    made = WallProfiles(wall)
    assert made.combinations.tolist() == [[1, 0], [0, 1]] and not len(made.mean) and made.smallest == 0.0
    assert made.products("values") == "values"
    assert PILE.profiles.gap == NoGap(12.0, 12.0, 0)


@pytest.fixture(scope="module")
def pair():
    shapes, places = [("buoy", (3.0, 2.0)), ("box", (8.0, 6.0, 4.0))], [Place(0, 0, 0), Place(9.0, 0, 0.0)]
    return prepare_several(shapes, places, 10.0, 1e-2)


def test_several_bodies_are_refined_each_and_keep_their_places(pair):
    assert pair.gaps == pytest.approx((2.0, 2.0), abs=2e-3)
    for better, made in (("finer", pair.finer), ("sharper", pair.sharper)):
        assert type(made) is SeveralBodies and made.cache == {} and made.gaps == pair.gaps
        assert made.places == pair.places
        for body, own in zip(pair.bodies, made.bodies, strict=True):
            alone = getattr(body, better)
            assert own.accuracy == beside(alone, 2.0).accuracy and own.plan == near(alone, pair.gaps[0])
    assert pair.sharper.tolerance == pytest.approx(0.1 * pair.tolerance)
    last = SimpleNamespace(bodies=(SimpleNamespace(sharper=None), pair.bodies[0]))
    assert SeveralBodies.sharper.func(last) is None


def test_functions_under_each_keel_are_for_a_digit_more():
    body = prepare_cylinder(3.0, 2.0, 10.0, 1e-2)
    terms = accuracy(body.accuracy.digits + 1, 2.0, 8.0, 3.0).terms
    made = beside(body, 0.5)
    assert made.accuracy == body.accuracy._replace(terms=max(body.accuracy.terms, terms)) and made.cache == {}
    assert (body.accuracy.terms, terms) == (1, 2) and made.plan == near(body, 0.5)
    assert beside(PILE, 0.5).accuracy == PILE.accuracy


def test_all_wavenumbers_of_a_step_of_a_fifth_have_one_exterior(pair):
    """k times the largest reach, rounded up to a power of 1.2, 1 at least; of κ the gap is resolved"""
    reach, asked = max(body.plan.reach for body in pair.bodies), []
    held = SimpleNamespace(bodies=pair.bodies, _exterior=lambda k, degrees: asked.append(k) or "exterior")
    for k in (0.5, 0.51, 0.9, 1e-3, 0.0):
        assert SeveralBodies.exterior(held, k, "degrees") == "exterior"
    steps = [1.2 ** np.ceil(np.log(max(k * reach, 1.0)) / np.log(1.2)) / reach for k in (0.5, 0.51, 0.9, 1e-3)]
    assert asked == pytest.approx([*steps, 0.0]) and asked[0] == asked[1]


def test_the_table_of_several_is_as_dense_as_that_of_each_and_reaches_as_far(pair):
    tops = tuple(one_frequency.degrees(body, 0.5)[1] for body in pair.bodies)
    each, both = [body.nodes(top) for body, top in zip(pair.bodies, tops, strict=True)], pair.nodes(tops)
    first, last = min(n.first for n in each), max(n.last for n in each)
    dense = max((n.count - 2) / np.log(n.last / n.first) for n in each)
    assert both == ChebyshevNodes(first, last, int(np.ceil(dense * np.log(last / first))) + 2)
    table = SimpleNamespace(kappa=np.array([3.6, 17.9, 18.0, 18.1]))
    assert SeveralBodies.coupled(SimpleNamespace(nodes=lambda tops: table, gaps=(3.0, 2.0)), tops) == 3
    degree = tuple(one_frequency.degrees(body, 0.5)[0] for body in pair.bodies)
    assert pair.degrees(0.5) == (degree, tops)


def test_modes_outside_are_for_the_body_that_needs_most_and_for_the_gap(pair):
    counts = [max(body.mode_count(0.2), body.profiles.gap.mode_count(0.2, body.accuracy.modes, gap))
              for body, gap in zip(pair.bodies, pair.gaps, strict=True)]  # fmt: skip
    assert pair.mode_count(0.2) == max(counts)
    modes = pair.outer_modes(1.4, 9.81)
    assert len(modes) == 2 and {len(m.wavenumbers) for m in modes} == {pair.mode_count(1.96 / 9.81)}
    assert pair.resolution(0.7)[:2] == pair.degrees(modes_k(0.7)) and pair.resolution(0.7)[2] > 0


def modes_k(omega):
    from hakobune.bem.waves import wavenumber

    return float(wavenumber(omega, 10.0, 9.80665))


def test_a_tolerance_is_of_half_a_digit_more_and_at_most_a_tenth():
    assert BOX.accuracy.digits == pytest.approx(3.5) and PILE.accuracy.digits == pytest.approx(3.5)
    assert prepare_box(30.0, 20.0, 5.0, 12.0, 0.1).accuracy.digits == pytest.approx(1.5)
    for tolerance in (0.105, 0.95e-7):
        with pytest.raises(ValueError, match="allowed: 1e-07 to 0.1"):  # noqa: RUF043
            prepare_box(30.0, 20.0, 5.0, 12.0, tolerance)


def test_bodies_are_as_near_as_a_two_hundredth_of_half_their_width():
    """0.015 m between circles of 3 m"""
    shapes = [("box", (6.0, 6.0, 2.0))] * 2
    with pytest.raises(
        ValueError, match=r"body 1 is 0\.0145 m from the next; the contour method needs at least 0\.015 m"
    ):
        prepare_several(shapes, [Place(0, 0, 0), Place(6.0145, 0, 0)], 10.0, 1e-2)
    assert prepare_several(shapes, [Place(0, 0, 0), Place(6.0155, 0, 0)], 10.0, 1e-2).gaps[0] == pytest.approx(0.0155)


def test_the_pieces_of_a_table_go_down_to_three_decays_of_its_largest_wavenumber(monkeypatch):
    """3/κ of the last node: at a tolerance of 1e-2 values change by 5e-4 if pieces end at 3 m"""
    body, seen = prepare_box(100.0, 50.0, 10.0, 20.0, 1e-2), []
    degree = tuple(int(d) + 2 for d in body.plan.degree(0.0, 1.0))
    made = Rectangle.layers
    monkeypatch.setattr(Rectangle, "layers", lambda *given: seen.append(given[-1]) or made(*given))
    potentials._tables(body, degree)
    assert seen == [pytest.approx(3 / body.nodes(degree).kappa.max())]
