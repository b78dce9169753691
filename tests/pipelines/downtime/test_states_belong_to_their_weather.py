"""States that are stored belong to their study, seeds, duration, weather and database, all of which count."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.downtime.hindcast import WaveHours
from hakobune.pipelines.downtime import simulated

HOURS = np.arange(3.0)


def identity(tmp_path, content=b"base", raw=("a", 1), seeds=3, hours=0.5, wave=None, second=None, **columns):
    """The identity with two wave systems, wind and current"""
    path = tmp_path / "base.h5"
    path.write_bytes(content)
    known = {"wind speed": HOURS, "wind from": 2 * HOURS, "current speed": 3 * HOURS, "current to": 4 * HOURS}
    known = {name: value for name, value in (known | columns).items() if value is not None}
    waves = [WaveHours(HOURS, 5 + HOURS, 6 + HOURS), WaveHours(7 + HOURS, 8 + HOURS, 9 + HOURS)]
    if wave is not None:
        waves[0] = waves[0]._replace(**wave)
    if second is not None:
        waves[1] = waves[1]._replace(**second)
    hindcast = SimpleNamespace(waves=waves, columns=known)
    ready = SimpleNamespace(raw=dict([raw]), task=SimpleNamespace(database=path))
    return simulated._identity(SimpleNamespace(seeds=seeds, duration_hours=hours), hindcast, ready)


CHANGES = [
    {"content": b"other"}, {"raw": ("a", 2)}, {"raw": ("b", 1)}, {"seeds": 4}, {"hours": 1.0},
    *({where: {part: HOURS + 0.5}} for where in ("wave", "second") for part in WaveHours._fields),
    *({name: HOURS + 0.5} for name in ("wind speed", "wind from", "current speed", "current to")),
    {"wind speed": None}, {"current speed": None},
]  # fmt: skip


@pytest.mark.parametrize("change", CHANGES, ids=str)
def test_every_input_of_a_state_counts(tmp_path, change):
    assert identity(tmp_path) == identity(tmp_path) != identity(tmp_path, **change)


def test_what_does_not_act_on_a_body_does_not_count(tmp_path):
    """A level or an ice cover of the hour, and a current without its direction"""
    assert identity(tmp_path, level=HOURS) == identity(tmp_path, ice=HOURS) == identity(tmp_path)
    half = {"current to": None}
    assert identity(tmp_path, **half) == identity(tmp_path, **half | {"current speed": HOURS + 9.0})
