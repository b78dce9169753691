"""Natural periods of a breakwater: motions are largest there, by a scan; and pictures have places around them."""

import numpy as np
import pytest

import hakobune
from hakobune.mooring.studies.breakwater.curves import response
from hakobune.mooring.studies.breakwater.natural import Natural, around

STUDY = {
    "holdings": ["free", "elastic"], "water": {"depth": 10.0},
    "section": {"shape": "rectangle", "beam": 12.0, "draft": 3.0, "height": 4.5},
    "body": {"center_of_gravity": 2.0, "gyration": 3.7, "free_draft": 2.0},
    "lines": {"angle_deg": 45.0, "attachment": 6.0, "spacing": 10.0, "allowable_kN": 1200.0, "axial_stiffness_kN": 6e4},
    "waves": {"height": 1.0, "periods": {"from": 2.5, "to": 9.0, "count": 9}},
}  # fmt: skip


@pytest.fixture(scope="module")
def made():
    return hakobune.breakwater(STUDY)


def found(made, holding, motion):
    (one,) = [one for one in made.detail.results.natural if (one.holding, one.motion) == (holding, motion)]
    return one


def test_heave_on_elastic_lines_is_largest_at_its_natural_period(made):
    """Below the study's own periods, in a sea's: the lines hold it so hard that its damping is small"""
    one = found(made, "elastic", "heave")
    period = np.linspace(0.97, 1.03, 121) * one.period
    scanned = response(made.detail.asked, "elastic", "potential flow", 0.0, 2 * np.pi / period)
    assert period[np.abs(scanned.heave).argmax()] == pytest.approx(one.period, rel=2e-3)
    assert one.front == pytest.approx(np.abs(scanned.front).max(), rel=0.02) and one.period < 2.5


def test_heave_at_its_natural_period_is_a_quarter_of_a_period_behind_its_force(made):
    """x = F/(−iωB): the force of the fixed body is that of the same section"""
    from hakobune.mooring.studies.breakwater.curves import sections

    one, asked = found(made, "free", "heave"), made.detail.asked
    omega = np.array([2 * np.pi / one.period])
    x = response(asked, "free", "potential flow", 0.0, omega).heave[0]
    (section,) = sections(asked, asked.afloat(0.0)[1], 0.0, omega)
    assert x == pytest.approx(section.excitation[1] / (-1j * omega[0] * section.damping[1, 1]), rel=1e-4)


def test_natural_periods_are_a_table_of_the_result(made):
    names = list(made.labels["natural"].values)
    assert names == ["free, heave", "free, roll", "elastic, heave", "elastic, sway and roll"]
    assert made["natural.period"][2] == found(made, "elastic", "heave").period
    assert np.isnan(made["natural.front"][:2]).all() and np.isfinite(made["natural.front"][2:]).all()


def test_places_around_a_natural_period_stay_within_the_study():
    period = around(np.array([2.0, 3.0, 4.0]), [Natural("free", "heave", 2.05, 1.0, np.nan)])
    assert period[0] == 2.0 and period[-1] == 4.0 and 2.05 in period and np.all(np.diff(period) > 0)
    assert np.min(np.diff(period)) < 0.006 and list(around(np.array([2.0, 3.0]), [])) == [2.0, 3.0]
