"""The waves of a record in a study, with its reading replaced: how long it has to be, what is cut, and what is told."""

import math
from collections import namedtuple
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment import wave_records
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.simulate import study

Record = namedtuple("Record", "elevation step")
Components = namedtuple("Components", "omega amplitude")
Carrier = namedtuple("Carrier", "speed absolute")
BAND = np.array([0.4, 1.0, 1.6])


@pytest.fixture
def record(monkeypatch):
    """`_record` of 21 values at 0.5 s and waves of some frequencies and amplitudes"""

    def call(every=((0.5, 3.0), (1.5, 4.0)), kept=None, count=21, ramp=2.0, duration=8.0, carrier=None, **given):
        asked = []
        table = {"file": "r.csv", "shortest": None, "direction_deg": 90.0, "incidence_deg": None} | given
        tables = SimpleNamespace(qtf="newman", sea=[], record=SimpleNamespace(**table))
        settings = SimpleNamespace(ramp=ramp, duration=duration)
        of = SimpleNamespace(
            waves=None, conditions=lambda: SimpleNamespace(current="stream"), water=SimpleNamespace(depth=9.0)
        )

        def components(first, towards, period):
            asked.append((len(first.elevation), towards, period))
            waves = every if period == 0 else every if kept is None else kept
            return Components(*(np.array([one[i] for one in waves]) for i in (0, 1)))

        monkeypatch.setattr(
            wave_records, "read_record", lambda path: asked.append(path) or Record(np.zeros(count), 0.5)
        )
        monkeypatch.setattr(wave_records, "components_of", components)
        monkeypatch.setattr(study, "carrier_of", lambda current: carrier if current == "stream" else 0)
        monkeypatch.setattr(
            study, "in_water", lambda waves, way, depth, g: asked.append(("met", way, depth, g)) or waves
        )
        found, told = study._record(of, tables, settings, BAND, "folder")
        return found, told, asked

    return call


def test_waves_are_those_of_the_run_and_its_ramp_down_to_the_shortest_that_is_stored(record):
    """10 s at 0.5 s are 21 values; the highest frequency is among the waves, whatever its rounding"""
    found, told, (path, first, second) = record(count=99)
    assert str(path) == "folder/r.csv" and first == (21, pytest.approx(math.pi / 2), 0.0)
    assert (
        second[:2] == first[:2]
        and second[2] < 2 * math.pi / 1.6
        and second[2] == pytest.approx(2 * math.pi / 1.6, rel=2e-9)
    )
    assert found.omega.tolist() == [0.5, 1.5] and told == ()
    assert record(shortest=7.0)[2][2][2] == 7.0
    with pytest.raises(StudyError, match=r"simulation\.record\.shortest is 0"):
        record(shortest=0.0)


@pytest.mark.parametrize("count, good", [(21, True), (20, False)])
def test_a_record_lasts_as_long_as_the_run_and_its_ramp(record, count, good):
    if good:
        record(count=count)
        return
    with pytest.raises(
        StudyError, match=r"simulation\.record lasts 9\.5 s; allowed: ramp and duration, 10 s, or longer"
    ):
        record(count=count)


def test_a_current_carries_waves_that_were_met_at_a_place(record):
    _, _, asked = record(carrier=Carrier(1.5, False))
    assert asked[-1] == ("met", Carrier(1.5, True), 9.0, 9.80665) and len(record()[2]) == 3


def test_there_are_waves_and_no_more_than_an_hour_can_have(record, monkeypatch):
    with pytest.raises(StudyError, match=r"simulation\.record has no waves of 3\.927 s or longer; lower shortest"):
        record(kept=())
    monkeypatch.setattr(study, "MOST_OF_RECORD", 2)
    record()
    monkeypatch.setattr(study, "MOST_OF_RECORD", 1)
    with pytest.raises(StudyError, match=r"simulation\.record has 2 waves; allowed: 1; give a longer shortest, or a"):
        record()


@pytest.mark.parametrize("share, told", [(0.009, False), (0.011, True)])
@pytest.mark.parametrize("shortest, way", [(None, "solve 1.9 rad/s and less"), (3.5, "give a shorter shortest")])
def test_energy_of_shorter_waves_that_are_left_out_is_told_above_a_hundredth(record, share, told, shortest, way):
    cut = math.sqrt(share / (1 - share))
    _, said, _ = record(((0.5, 1.0), (1.9, cut)), ((0.5, 1.0),), shortest=shortest)
    period = 2 * math.pi / 1.6 if shortest is None else shortest
    line = f"{100 * share:.3g} % of the record's energy is of waves below {period:.3g} s, left out; {way}"
    assert said == ((line,) if told else ())


@pytest.mark.parametrize("share, told", [(0.009, False), (0.011, True)])
@pytest.mark.parametrize("omega", [0.39, 1.61])
def test_energy_outside_the_stored_band_on_either_side_is_told_above_a_hundredth(record, share, told, omega):
    out = math.sqrt(share / (1 - share))
    waves = sorted(((0.4, 0.6), (1.6, 0.8), (omega, out)))
    _, said, _ = record(waves)
    line = (
        f"{100 * share:.3g} % of the record's energy lies outside the stored frequencies, 0.4 to 1.6 rad/s, and is not "
        f"included; solve {min(0.4, omega):.3g} rad/s and above"
    )
    assert said == ((line,) if told else ())
