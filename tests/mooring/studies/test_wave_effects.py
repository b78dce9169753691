"""Waves of a mooring study: a sea unless the report's regular wave is asked for, both said where they differ."""

import numpy as np
import pytest
from chain_study import chain_study

from hakobune.bem.database import open_database
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.sea_state import sea_state
from hakobune.pipelines.cli import main
from hakobune.pipelines.moor.result import moor

BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 100 --gyration 15.55,29.44,32.28"
STUDY = f"""{chain_study([45])}[waves]
height = 4.5
period = 10.0
direction_deg = 90.0
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("moor")
    (folder / "study.toml").write_text(STUDY)
    words = [*BOX.split(), "--omega", "0.3:1.05:9", "--heading", "0,45,90", "--output", str(folder / "box.h5")]
    assert main(words) == 0
    return folder


def test_a_mooring_study_and_a_response_study_agree_on_one_sea(folder):
    """Drift is the integral over the spectrum and the sway used for the lines the largest expected in three hours."""
    result = moor(folder / "study.toml", folder / "box.h5").detail[0]
    body = open_database(folder / "box.h5").reader.floating()
    state = sea_state(body, Sea(issc(4.5, mean_period=10.0), np.pi / 2), 10800.0)
    assert np.isclose(result.loads["drift"][1], state.slow.drift[1], rtol=1e-9)
    assert np.allclose(result.amplitudes, state.expected_maximum[:6], rtol=1e-9)
    D = body.drift(body.omega, [np.pi / 2])[:, 0, 1]
    omega = np.linspace(0.3, 1.05, 2001)
    density = state.sea.spectrum.density(omega)
    inside = 2 * np.trapezoid(np.interp(omega, body.omega, D) * density, omega)
    assert np.isclose(result.loads["drift"][1], inside, rtol=0.25)  # straight lines between nine frequencies


def test_the_regular_wave_of_the_report_is_a_named_choice_and_twice_the_energy(folder, tmp_path):
    named = tmp_path / "named.toml"
    named.write_text(STUDY + 'method = "regular_wave"\n')
    kept = moor(named, folder / "box.h5")
    regular = kept.detail[0]
    body = open_database(folder / "box.h5").reader
    D = body.drift([2 * np.pi / 10], [np.pi / 2])[0, 0]
    assert np.isclose(regular.loads["drift"][1], 2.25**2 * D[1])
    irregular = moor(folder / "study.toml", folder / "box.h5").detail[0]
    assert regular.loads["drift"][1] > 2 * irregular.loads["drift"][1]
    for one, other in ((regular, irregular), (irregular, regular)):
        assert np.allclose(one.waves[other.conditions.method].amplitudes, other.amplitudes)
    assert np.allclose(kept["drift.irregular"], irregular.loads["drift"][[0, 1, 5]])
    assert kept.quantity("drift.irregular").description.startswith("not used")


def test_both_methods_are_printed_and_which_is_not_used(folder, capsys):
    assert main(["moor", str(folder / "study.toml"), "--database", str(folder / "box.h5")]) == 1
    said = " ".join(capsys.readouterr().out.split())
    assert "FAILS: " in said and "irregular" in said and "not used:" in said
    assert "slow drift about the mean, standard deviations Fx 0, Fy" in said


def test_a_method_that_there_is_not_is_refused(folder, tmp_path, capsys):
    (tmp_path / "study.toml").write_text(STUDY + 'method = "regular"\n')
    assert main(["moor", str(tmp_path / "study.toml"), "--database", str(folder / "box.h5")]) == 2
    assert "waves.method is 'regular'; allowed: irregular, regular_wave" in capsys.readouterr().err
