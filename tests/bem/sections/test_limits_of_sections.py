"""What sections and the contour method refuse, from both sides of each limit, and how much effort they take."""

import numpy as np
import pytest

from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.sections.coefficients import check_shape, effort, frequency_of, report_row, section, section_flow
from hakobune.bem.sections.outline import rectangle
from hakobune.bem.sections.tables import BEAM_DRAFT, COLUMNS, DEPTH_DRAFT, XI, row_of, table_name

G = 9.80665


def test_waves_of_three_hundred_drafts_are_the_shortest():
    """kd"""
    for kd, refused in ((299.0, False), (301.0, True)):
        omega = np.sqrt(G * kd / 0.01)
        if refused:
            with pytest.raises(
                ValueError, match="and wavenumber times draft is 301; allowed: up to 300, beyond which waves are"
            ):
                section_flow(1.0, 0.01, 0.05, omega)
        else:
            section_flow(0.02, 0.01, 0.05, omega, tolerance=1e-3)


def test_waves_nearly_along_a_body_are_refused():
    section(10.0, 4.0, 9.0, 0.8, obliquity=np.radians(89.85), tolerance=1e-3)
    for degrees in (89.95, -89.95):
        with pytest.raises(ValueError, match=r"obliquity is -?89.95°; allowed: up to ±89.9"):
            section(10.0, 4.0, 9.0, 0.8, obliquity=np.radians(degrees))
    with pytest.raises(ValueError, match="obliquity is 10° in deep water; allowed: obliquity 0, or a finite depth"):
        section(10.0, 4.0, np.inf, 0.8, obliquity=np.radians(10))


def test_waves_within_a_ten_thousandth_of_the_normal_are_normal():
    plain, near, off = (section_flow(10.0, 4.0, 9.0, 0.8, tolerance=1e-3, obliquity=np.arcsin(sine))
                        for sine in (0.0, 0.99e-4, 1.01e-4))  # fmt: skip
    assert near.haskind_integral([0.3])[0, 0] == plain.haskind_integral([0.3])[0, 0]
    assert off.haskind_integral([0.3])[0, 0] != plain.haskind_integral([0.3])[0, 0]


def test_functions_and_modes_are_as_many_as_the_tolerance_asks_for():
    """1 + ⌈digits/6 √max(r, 1)⌉; 25, 50, 100 and 400 modes from 1e-3, 1e-5, 1e-6 and 1e-8; r to where 12 are enough"""
    for tolerance, depth, terms, modes in ((1e-3, 8.0, 2, 25), (0.9e-3, 8.0, 2, 50), (1e-5, 8.0, 2, 50),
                                           (1e-6, 8.0, 2, 100), (0.9e-6, 8.0, 3, 400), (1e-6, 4 + 4 * 4.1, 4, 100),
                                           (1e-6, 4 + 3.9 * 4, 3, 100), (1e-8, 8.0, 3, 400)):  # fmt: skip
        assert effort(10.0, 4.0, depth, tolerance) == (terms, modes)
    assert effort(4.0, 4.0, 4 + 4.1 * 2, 1e-6)[0] == 4  # half the beam where that is less
    assert effort(10.0, 4.0, 4 + 4 * 120.9, 1e-6)[0] == 12
    with pytest.raises(ValueError, match=r"depth − draft is 121 times .* up to 121 at tolerance 1e-06, or depth inf"):
        effort(10.0, 4.0, 4 + 4 * 121.1, 1e-6)


@pytest.mark.parametrize(
    "sizes, words",
    [
        ((0.0, 4.0, 9.0, 1e-3), "beam is 0 m"),
        ((10.0, np.inf, 9.0, 1e-3), "draft is inf m"),
        ((10.0, 4.0, 4.0, 1e-3), "depth is 4 m at draft 4 m; allowed: above the draft"),
        ((10.0, 4.0, 9.0, 0.9e-8), "tolerance is 9e-09; allowed: 1e-08 to below 1"),
        ((10.0, 4.0, 9.0, 1.0), "tolerance is 1; allowed: 1e-08 to below 1"),
    ],
)
def test_what_is_no_section_is_named(sizes, words):
    check_shape(10.0, 4.0, 9.0, 1e-8)
    check_shape(10.0, 4.0, 9.0, 0.999)
    with pytest.raises(ValueError, match=words):
        check_shape(*sizes)


def test_a_row_of_the_report_is_made_dimensionless_by_half_the_beam():
    """M/ρS, N/ρSω, with b for each arm; E/ρgb and ρgb²; ξ_B = ω²b/g, S = Bd"""
    omega, rho = 0.9, 1025.0
    one = section(12.0, 4.0, 9.0, omega)
    row, b, S = report_row(one), 6.0, 48.0
    assert row["xi_B"] == pytest.approx(omega**2 * b / G) and row["B_over_d"] == 3.0 and row["H_over_d"] == 2.25
    assert frequency_of(row["xi_B"], 12.0) == pytest.approx(omega)
    assert row["M_H"] == pytest.approx(one.added_mass[1, 1] / (rho * S))
    assert row["N_S"] == pytest.approx(one.damping[0, 0] / (rho * S * omega))
    assert row["M_R"] == pytest.approx(one.added_mass[2, 2] / (rho * S * b * b))
    assert row["N_SR"] == pytest.approx(one.damping[0, 2] / (rho * S * b * omega))
    assert row["E_H"] == pytest.approx(abs(one.excitation[1]) / (rho * G * b))
    assert row["E_R"] == pytest.approx(abs(one.excitation[2]) / (rho * G * b * b))
    assert row["eps_S_deg"] == pytest.approx(np.degrees(np.angle(one.excitation[0])))
    assert set(row) == set(COLUMNS)
    assert row["reflected"] ** 2 + row["transmitted"] ** 2 == pytest.approx(1, rel=1e-6)  # energy of the fixed body
    kh = 2 * one.k * one.depth
    assert row["drift"] == pytest.approx(row["reflected"] ** 2 * (1 + kh / np.sinh(kh)), rel=1e-6)  # Longuet-Higgins


def test_the_twenty_tables_of_the_report_are_of_its_shapes_and_frequencies():
    """SR179 report (1982), tables 2.1.3.1-20: H/d 1.2 to 10 in the outer, B/d 5 to 20 in the inner order, ten ξ_B"""
    assert BEAM_DRAFT == (5, 10, 15, 20) and DEPTH_DRAFT == (1.2, 1.4, 2, 3, 10)
    assert XI == (0.1, 0.2, 0.4, 0.6, 0.8, 1, 1.5, 2, 2.5, 3)
    for H, B, name in ((1.2, 5, "2.1.3.1"), (1.2, 10, "2.1.3.2"), (1.4, 5, "2.1.3.5"), (10, 20, "2.1.3.20")):
        assert table_name({"H_over_d": float(H), "B_over_d": float(B)}) == name
    assert table_name({"H_over_d": 1.3, "B_over_d": 5.0}) == ""
    for xi in (0.0, np.inf):
        with pytest.raises(ValueError, match=r"xi_B is .*; allowed: above 0 and finite"):
            row_of(5.0, 2.0, xi)


def test_the_contour_method_takes_tolerances_from_a_ten_millionth_to_a_tenth_and_gaps_of_1400_drafts():
    for tolerance, taken in ((1e-7, True), (0.9e-7, False), (0.1, True), (0.105, False)):
        if taken:
            assert prepare_cylinder(10.0, 5.0, 20.0, tolerance).tolerance == pytest.approx(tolerance * 10**-0.5)
        else:
            with pytest.raises(ValueError, match=r"allowed: 1e-07 to 0.1"):
                prepare_cylinder(10.0, 5.0, 20.0, tolerance)
    prepare_box(40.0, 20.0, 5.0, 5 + 1399 * 5)
    with pytest.raises(
        ValueError, match="depth is 7010 m; allowed: up to 7005 m; in deeper water use the panel method"
    ):
        prepare_box(40.0, 20.0, 5.0, 7010)
    with pytest.raises(ValueError, match=r"allowed: up to .* in deeper water"):
        prepare_box(40.0, 4.0, 5.0, 7000)  # half the width where that is less


def test_ten_times_as_sharp_is_a_digit_more_until_the_last():
    body = prepare_box(40.0, 20.0, 5.0, 10.0, 1e-5)
    assert body.sharper.tolerance == pytest.approx(body.tolerance / 10)
    assert body.sharper.sharper.tolerance == pytest.approx(body.tolerance / 100)
    assert body.sharper.sharper.sharper is None
    assert body.finer.accuracy.digits == pytest.approx(body.accuracy.digits + 1)


def test_any_outline_takes_finite_depth_and_tolerances_from_a_ten_millionth():
    from hakobune.bem.sections.any_section import any_section

    wetted = rectangle(10.0, 8.0).wetted(4.0)
    with pytest.raises(ValueError, match="depth is inf m at draft 4 m; allowed: above the draft, finite"):
        any_section(wetted, np.inf, 0.8)
    for tolerance in (0.9e-7, 1.0):
        with pytest.raises(ValueError, match=r"tolerance is .*; allowed: 1e-07 to below 1"):
            any_section(wetted, 9.0, 0.8, tolerance=tolerance)
    with pytest.raises(ValueError, match=r"the section needs .* panels at this frequency; allowed: 250"):
        any_section(wetted, 9.0, np.sqrt(G * 200.0), tolerance=1e-3)


@pytest.mark.parametrize("lid", [True, False])
def test_limits_are_sums_over_as_many_modes_as_the_gap_asks_for(lid):
    """nπ/h under a lid, (n − ½)π/h under a surface without pressure, n from 1; norms h/2"""
    from hakobune.bem.sections.frequency_limits import LimitFlow

    flow = LimitFlow(8.0, 2.0, 5.0, lid, 4, 30)
    count = flow.shape.gap.mode_count(0.0, 30)
    n = np.arange(1, count + 1)
    assert flow.modes.wavenumbers == pytest.approx((n if lid else n - 0.5) * np.pi / 5.0)
    assert flow.modes.norms == pytest.approx(np.full(count, 2.5)) and flow.modes.rows.shape[1] == count
