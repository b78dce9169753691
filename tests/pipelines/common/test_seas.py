"""One table of seas for every study: five kinds of period, swell beside the sea, and who refuses what."""

import tomllib

import numpy as np
import pytest
from scipy.special import gamma

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.seas import spectra_files
from hakobune.mooring.seas.planes import TabulatedSpreading
from hakobune.mooring.seas.systems import Systems
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.typed import typed
from hakobune.pipelines.common.weather.seas import PERIODS, SeaTable, seas_at
from hakobune.pipelines.common.weather.water import check_solved_depth
from hakobune.pipelines.design.tables import StateTable
from hakobune.pipelines.line_dynamics.study import LineSeaTable
from hakobune.pipelines.moor.study import make_study, read_study
from hakobune.pipelines.response.study import SeaTable as ResponseSea
from hakobune.pipelines.simulate.study import plan_of
from hakobune.pipelines.single_point.tables import WavesTable as SinglePointWaves

HEAD = "[water]\ndepth = 20.0\n[hull]\nfreeboard = 10.0\n[waves]\nheight = 3.0\nincidence_deg = 0.0\n"
# of S = A ω⁻⁵ exp(−B ω⁻⁴), moments m_n = A B^(n/4 − 1) Γ(1 − n/4)/4 and a peak where ω⁴ = 4B/5, in units of 2π B^(−1/4)
OF_B = {
    "mean_period": 1 / gamma(3 / 4),
    "zero_crossing_period": np.pi**-0.25,
    "energy_period": gamma(5 / 4),
    "peak_period": 1.25**0.25,
}
SWELL = "[[waves.swell]]\nheight = 4.0\npeak_period = 14.0\ndirection_deg = 60.0\n"


def sea(text):
    return make_study(tomllib.loads(HEAD + text)).conditions()


@pytest.mark.parametrize("kind", OF_B)
def test_every_kind_of_period_means_the_same_sea(kind):
    """Periods of Bretschneider's shape stand to each other as gamma functions"""
    wanted = 9.0 * OF_B["mean_period"]
    found = sea(f'spectrum = "bretschneider"\n{kind} = {9.0 * OF_B[kind]}\n')
    assert found.waves.height == 3.0 and found.waves.period == pytest.approx(wanted, rel=1e-3)
    omega = np.array([0.5, 0.7, 1.0])
    same = sea(f'spectrum = "bretschneider"\nperiod = {wanted}\n').sea.spectrum
    assert found.sea.spectrum.density(omega) == pytest.approx(same.density(omega), rel=2e-3)


@pytest.mark.parametrize("table", [ResponseSea, SinglePointWaves, LineSeaTable, SeaTable])
def test_every_study_knows_every_kind_of_period(table):
    for kind in PERIODS:
        raw = {"height": 3.0, kind: 9.0, "direction_deg": 30.0, "spectrum": "bretschneider"}
        found = typed(raw, table, StudyError).sea("sea", 20.0)
        assert found.spectrum.significant_height == pytest.approx(3.0, rel=1e-3)
        assert found.direction == pytest.approx(np.radians(30.0))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "waves: no period is given; allowed: one of period, mean_period"),
        ("period = 9.0\npeak_period = 12.0\n", "waves: period and peak_period are given; allowed: one of"),
        ("peak_period = -1.0\n", "waves.peak_period is -1"),
        (f'period = 9.0\nmethod = "regular_wave"\n{SWELL}', "waves.swell is given with method"),
        ("period = 9.0\n[[waves.swell]]\nheight = 1.0\ndirection_deg = 0.0\n", r"waves.swell\[0\]: no period is given"),
    ],
)
def test_a_fault_is_told_by_its_key(text, said):
    with pytest.raises(StudyError, match=said):
        sea(text)


def test_swell_and_sea_add_their_energies():
    """3 m and 4 m are 5 m; the mean direction is that of the energies, 9 to 16"""
    found = sea(f"period = 8.0\n{SWELL}")
    assert isinstance(found.sea, Systems)
    assert found.waves.height == pytest.approx(5.0, rel=1e-3)
    towards = np.angle(9 * np.exp(1j * np.pi) + 16 * np.exp(1j * np.pi / 3))
    assert found.waves.direction == pytest.approx(towards, abs=1e-3)


def test_a_simulation_has_a_sea_for_each_system():
    text = f"period = 8.0\n{SWELL}[simulation]\nduration = 600.0\n"
    plan = plan_of(make_study(tomllib.loads(HEAD + text)), np.linspace(0.1, 2.5, 60))
    heights = [one.spectrum.significant_height for one in plan.weather.seas]
    assert heights == pytest.approx([3.0, 4.0], rel=1e-3)


def test_a_state_of_a_design_may_have_a_swell():
    raw = {"name": "a", "state": "normal", "incidence_deg": [0.0]}
    waves = {"height": 3.0, "peak_period": 9.0, "swell": [{"height": 1.0, "peak_period": 14.0, "direction_deg": 60.0}]}
    state = typed(raw | {"waves": waves}, StateTable, StudyError)
    assert state.waves.swell[0].sea("swell", 20.0).direction == pytest.approx(np.pi / 3)


def test_a_spectrum_of_a_file_is_a_sea_of_any_study(tmp_path):
    """A triangle of 0.04 Hz and 3.125 m²/Hz has m₀ = 1/16 m², 1 m, at 1/12.5 s; beside 3 m that is √10 m"""
    (tmp_path / "buoy.csv").write_text("frequency_hz,density_m2_hz\n0.06,0\n0.08,3.125\n0.10,0\n")
    swell = '[[waves.swell]]\nfile = "buoy.csv"\ndirection_deg = 60.0\n'
    (tmp_path / "study.toml").write_text(f"{HEAD}period = 8.0\n{swell}")
    study, text = read_study(tmp_path / "study.toml")
    assert study.conditions().waves.height == pytest.approx(10**0.5, rel=1e-3)
    (tmp_path / "buoy.csv").write_text("frequency_hz,density_m2_hz\n0.06,0\n0.08,6.25\n0.10,0\n")
    again, later = read_study(tmp_path / "study.toml")
    assert text != later  # what was made of another file is made again
    assert again.conditions().waves.height == pytest.approx(11**0.5, rel=1e-3)
    (tmp_path / "study.toml").write_text(f'{HEAD}period = 8.0\nswell = ["buoy.csv"]\n')
    with pytest.raises(StudyError, match=r"waves.swell\[0\] is 'buoy.csv'; allowed: a table"):
        read_study(tmp_path / "study.toml")


def test_files_of_all_seas_of_a_simulation_lie_beside_its_study(tmp_path):
    swell = {"height": 1.0, "swell": [{"file": "swell.csv"}]}
    raw = {"sea": {"file": "buoy.csv"}, "simulation": {"seeds": 3, "sea": [{"file": "later.csv"}, swell, "none"]}}
    found, files = seas_at(raw, tmp_path)
    assert files == [tmp_path / "buoy.csv", tmp_path / "later.csv", tmp_path / "swell.csv"]
    first, second, third = found["simulation"]["sea"]
    assert found["simulation"]["seeds"] == 3 and third == "none" and first == {"file": str(tmp_path / "later.csv")}
    assert second == {"height": 1.0, "swell": [{"file": str(tmp_path / "swell.csv")}]}
    assert raw["sea"]["file"] == "buoy.csv" and seas_at({"waves": {}}, tmp_path) == ({"waves": {}}, [])


@pytest.mark.parametrize(
    ("key", "meant"), [("Tp", "peak_period"), ("Hs", "height"), ("peak_perod", "peak_period"), ("systems", "swell")]
)
def test_a_key_of_another_name_is_told_by_the_one_that_is_meant(key, meant):
    with pytest.raises(StudyError, match=rf"waves.{key} is unknown, {meant} may be meant; allowed: "):
        sea(f"{key} = 9.0\n")


def test_deep_water_is_any_of_half_a_length():
    """Waves of 4 s are gT²/2π = 24.97 m long"""
    check_solved_depth(12.5, np.inf, "box.h5", 4.0)
    check_solved_depth(3.0, np.inf, "box.h5")
    with pytest.raises(
        StudyError,
        match=r"is for deep water, and the bed affects waves of 4 s in depths below "
        r"12.5 m; solve the body in 12.4 m",
    ):
        check_solved_depth(12.4, np.inf, "box.h5", 4.0)
    with pytest.raises(StudyError, match=r"water.depth is 12.5 m, but box.h5 is for 20 m; allowed: the same depth"):
        check_solved_depth(12.5, 20.0, "box.h5")


PLANE = TabulatedSpreading(np.array([0.5, 1.0]), np.array([0.0, np.pi, 2 * np.pi]), np.full((2, 3), 0.5 / np.pi))


@pytest.mark.parametrize("more, towards", [({}, None), ({"direction_deg": 60.0}, 60.0),
                                           ({"incidence_deg": 30.0}, 210.0),
                                           ({"spreading": "cosine:4"}, None)])  # fmt: skip
def test_what_the_study_says_of_directions_goes_before_what_a_file_says_but_not_before_a_plane(
    more, towards, monkeypatch
):
    """Incidence χ is β = χ + 180°; a spectrum over directions has all of its own"""
    spectrum = jonswap(2.0, peak_period=9.0)
    table = typed({"file": "sea.spec", **more}, SeaTable, StudyError)
    monkeypatch.setattr(spectra_files, "read_sea", lambda *_: Sea(spectrum, 0.5, CosinePower(2)))
    sea = table.sea("waves", 20.0)
    assert np.degrees(sea.direction) % 360 == pytest.approx(np.degrees(0.5) if towards is None else towards)
    assert sea.spreading == CosinePower(4 if "spreading" in more else 2)
    monkeypatch.setattr(spectra_files, "read_sea", lambda *_: Sea(spectrum, 0.5, PLANE))
    if more:
        with pytest.raises(
            StudyError, match=r"waves: sea\.spec contains directions; leave out direction and spreading"
        ):
            table.sea("waves", 20.0)
    else:
        assert table.sea("waves", 20.0).spreading is PLANE


def test_all_unknown_keys_of_a_file_are_told_at_once(tmp_path):
    """Three tables deep, in a list of tables and in tables that the user named"""
    (tmp_path / "study.toml").write_text(
        "[water]\ndepth = 20.0\n[types.chain]\nfriction = 0.5\n"
        '[[spreads]]\ntype = "chain"\npretension_t = 3.0\n[[waves.swell]]\nhs = 1.0\n[wind]\nspeed = 3.0\ncolour = 1\n'
    )
    with pytest.raises(StudyError) as told:
        read_study(tmp_path / "study.toml")
    first, allowed, *more = str(told.value).split("; ")
    assert first == "types.chain.friction is unknown, bed_friction may be meant" and allowed.startswith("allowed: ")
    assert more == [
        "also unknown: spreads[0].pretension_t, pretension_tonf may be meant",
        "waves.swell[0].hs, height may be meant",
        "wind.colour",
    ]
