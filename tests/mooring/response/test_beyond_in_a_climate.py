"""What a climate says of waves beyond the stored band, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.response.climate import _drift_beyond, _energy_beyond, _responses_beyond

PROBABILITY = np.array([0.6, 0.3, 0.1])
BODY = SimpleNamespace(omega=np.array([0.25 * np.pi, 1.0, 0.5 * np.pi]))  # 8 to 4 s


def test_time_with_waves_beyond_the_band_is_the_sum_of_its_classes():
    (said,) = _energy_beyond(BODY, PROBABILITY, np.array([0.0, 0.02, 0.3]))
    assert said.startswith(
        "in 40 % of the time more than 1 % of the wave energy is beyond the stored 4 to 8 s (in the worst sea 30 %)"
    )
    assert "(in the worst sea 30 %);" in said
    assert not list(_energy_beyond(BODY, PROBABILITY, np.array([0.0, 0.009, 0.0])))


@pytest.mark.parametrize("more, told", [(0.98e-2, False), (1.05e-2, True)])
def test_a_hundredth_of_a_response_over_all_time_is_told(more, told):
    """Energy beyond over all of it: 0.6 · 1 + 0.3 · 2 + 0.1 · 4 = 1.6 inside, `more` of the sum beyond"""
    m0 = np.array([[1.0], [2.0], [4.0]])
    beyond = np.array([[0.0], [0.0], [10 * 1.6 * more / (1 - more)]])
    said = list(_responses_beyond(("heave",), PROBABILITY, m0, beyond))
    assert len(said) == told
    assert not told or "heave 1.0 %" in said[0] or "heave 1.1 %" in said[0]


def test_the_share_of_drift_beyond_the_band_is_of_its_mean_over_all_time():
    """0.6 · 10 + 0.3 · 20 + 0.1 · 80 = 20 kN of surge, 0.1 · 30 = 3 kN of it beyond: 15 %; moments do not count"""
    drift = np.array([[10.0, 0, 1.0], [-20.0, 0, 1.0], [80.0, 0, 1.0]])
    beyond = np.array([[0.0, 0, 9.0], [0.0, 0, 9.0], [30.0, 0, 9.0]])
    (said,) = _drift_beyond(BODY, PROBABILITY, drift, beyond)
    assert said.startswith("15.0 % of the mean drift force over all time") and "1.57 rad/s" in said
    assert not list(_drift_beyond(BODY, PROBABILITY, drift, beyond / 16))
    assert not list(_drift_beyond(BODY, PROBABILITY, None, None))
