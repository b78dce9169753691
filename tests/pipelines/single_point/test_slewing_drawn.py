"""The picture of a slewing body, read back: heading, pull and worst line over time, and the track of body and buoy; and
limits of its settings."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.single_point import maps, pictures, running

TIME = np.linspace(0.0, 12.0, 13)
LINE = np.linspace(1e5, 5e5, 13)


def run_of(hawser=True, still=False):
    """A hull of 100 m that turns by 0.02 rad an interval; wave motions of 0.1 rad are added to it"""
    n = len(TIME)
    wave = np.zeros((n, 6))
    wave[:, 5] = 0.0 if still else 0.1
    heading = np.full(n, 0.5) if still else 0.02 * np.arange(n)
    place = np.column_stack([np.arange(n), -2.0 * np.arange(n)])
    record = SimpleNamespace(
        time=TIME, heading=heading, wave=wave, hawser=np.full((n, 1), 4e5) * (1 if still else TIME[:, None]),
        lines=np.column_stack([np.full(n, 3e5), LINE, np.full(n, 4e5)]), place=place, buoy=place + 50.0,
    )  # fmt: skip
    point = SimpleNamespace(
        lengths=np.array([30.0 if hawser else 0.0]),
        ends=np.zeros((1, 2)),
        origin=np.zeros(2),
        system=SimpleNamespace(line_names=("a", "b", "c")),
    )
    return SimpleNamespace(record=record, steady=SimpleNamespace(heading=0.5, point=point, lines="lines at rest"))


@pytest.fixture
def drawn(monkeypatch, tmp_path):
    made = []
    monkeypatch.setattr("hakobune.pipelines.single_point.pictures.save", lambda *given: made.append(given))
    monkeypatch.setattr(pictures, "draw_hull", lambda axes, *given, **style: made.append((axes, given, style)))
    monkeypatch.setattr(pictures, "draw_lines", lambda axes, lines: made.append((axes, lines)))

    def call(**more):
        made.clear()
        run, study = run_of(**more), SimpleNamespace(hull=SimpleNamespace(length=100.0))
        pictures.draw_run(study, run, tmp_path / "s.png")
        (figure, path, dpi) = made[-1]
        assert (path, dpi) == (tmp_path / "s.png", 150) and figure.get_size_inches().tolist() == [14.0, 8.0]
        return figure.axes, made[:-1], run, study

    return call


def test_heading_hawser_and_the_worst_line_are_drawn_over_time_in_degrees_and_kilonewtons(drawn):
    (heading, hawser, lines, *_), *_ = drawn()
    course, rest = heading.lines
    assert course.get_xdata().tolist() == TIME.tolist()
    assert course.get_ydata() == pytest.approx(np.degrees(0.02 * np.arange(13) + 0.1))
    assert list(rest.get_ydata()) == pytest.approx([np.degrees(0.5)] * 2) and heading.get_ylabel() == "heading, °"
    assert hawser.lines[0].get_ydata() == pytest.approx(400.0 * TIME) and hawser.get_ylabel() == "hawser, kN"
    assert lines.lines[0].get_ydata() == pytest.approx(np.linspace(100.0, 500.0, 13))
    assert (lines.get_ylabel(), lines.get_xlabel()) == ("b, kN", "time, s")
    assert [text.get_text() for text in heading.get_legend().get_texts()] == ["of rest"]


def test_without_a_hawser_the_hull_pulls_on_the_buoy_and_a_constant_record_is_a_level_line(drawn):
    (heading, hawser, *_), *_ = drawn(hawser=False, still=True)
    assert hawser.get_ylabel() == "pull on buoy, kN"
    for axes, value in ((heading, np.degrees(0.5)), (hawser, 400.0)):
        low, high = axes.get_ylim()
        assert 0.5 * (low + high) == pytest.approx(value) and 0.5 * (high - low) == pytest.approx(
            pictures.STILL * value
        )


def test_the_plan_has_the_hull_at_both_ends_of_its_swing_and_the_buoy_its_own_track(drawn):
    """The heading rises from begin to end: two hulls"""
    (*_, plan, buoy), (lines, *hulls), run, study = drawn()
    assert lines == (plan, "lines at rest") and len(hulls) == 2
    assert [one[1][3] for one in hulls] == pytest.approx([0.0, 0.02 * 12])
    axes, (of, point, place, _), style = hulls[1]
    assert axes is plan and of is study and point is run.steady.point and place.tolist() == [12.0, -24.0]
    assert style["label"] == "hull at 12 s, 13.8°"
    assert plan.lines[-1].get_xydata().tolist() == run.record.place.tolist()
    assert (plan.get_xlabel(), plan.get_ylabel(), plan.get_aspect()) == ("x, m", "y, m", 1.0)
    assert buoy.lines[0].get_xydata().tolist() == run.record.buoy.tolist()
    assert buoy.get_title() == "buoy: 70.7 m at most from + (without the hull)"  # (50, 50) from (0, 0)


GOOD = {"duration": 100.0, "slow_step": 1.0, "tolerance": 1e-3, "step": None, "scheme": None, "waves_after": 100.0,
        "offset_deg": 180.0, "components": 1, "seed": 0}  # fmt: skip


@pytest.mark.parametrize("change, says", [
    *(({key: 0.0}, f"slewing.{key} is 0") for key in ("duration", "slow_step", "tolerance", "step")),
    ({"scheme": "guess"}, "slewing.scheme is 'guess'; allowed: "),
    ({"waves_after": -1.0}, "slewing.waves_after is -1 s"),
    ({"waves_after": 100.1}, "slewing.waves_after is 100.1 s; allowed: 0 to the duration of 100 s"),
    ({"offset_deg": 180.1}, "slewing.offset_deg is 180.1; allowed: −180 to 180"),
    ({"offset_deg": -180.1}, "is -180.1"),
    ({"components": 0}, "slewing: components must be at least 1, and the seed a whole number from 0"),
    ({"seed": -1}, "slewing: components must be at least 1"),
])  # fmt: skip
def test_settings_of_slewing(change, says):
    for scheme in (None, *running.SCHEMES):
        running._check(SimpleNamespace(**GOOD | {"scheme": scheme}))
    with pytest.raises(StudyError) as refused:
        running._check(SimpleNamespace(**GOOD | change))
    assert says in str(refused.value)


@pytest.mark.parametrize("step, good", [(None, True), (0.19, False), (0.21, True)])
def test_slewing_has_a_number_of_samples_that_fits(monkeypatch, step, good):
    """100 s at 0.2 s, the default, are 500 samples"""
    monkeypatch.setattr(running, "MOST_SAMPLES", 500)
    if good:
        running._check(SimpleNamespace(**GOOD | {"step": step}))
        return
    with pytest.raises(StudyError, match="slewing has more than 500 samples; give a longer step"):
        running._check(SimpleNamespace(**GOOD | {"step": step}))


def map_of(growth, keys=("hawser.length", "wind.speed")):
    growth = np.array(growth)
    return SimpleNamespace(keys=keys, x=np.array([10.0, 20.0]), y=np.array([5.0, 6.0])[: len(growth)], growth=growth)


@pytest.fixture
def mapped(monkeypatch):
    made = []
    monkeypatch.setattr(maps, "save", lambda *given: made.append(given))
    monkeypatch.setattr(maps, "_named", lambda key: f"{key}, unit")

    def call(found):
        maps.draw(found, "m.png")
        figure, path, dpi = made[-1]
        assert (path, dpi) == ("m.png", 150) and figure.axes[0].get_title() == "slewing"
        return figure.axes

    return call


def test_a_map_of_one_key_is_a_line_of_growth_an_hour(mapped):
    """1e-4 1/s are 0.36 1/h"""
    (axes,) = mapped(map_of([[1e-4, -2e-4]], ("hawser.length",)))
    line, zero = axes.lines
    assert line.get_xydata() == pytest.approx(np.array([[10, 0.36], [20, -0.72]])) and list(zero.get_ydata()) == [0, 0]
    assert axes.get_ylabel() == "growth of the slowest motion, 1/h (slewing above 0)"
    assert axes.get_xlabel() == "hawser.length, unit"


@pytest.mark.parametrize("growth, bordered", [
    ([[1e-4, -2e-4], [3e-4, 1e-4]], True), ([[1e-4, 2e-4], [3e-4, 1e-4]], False),
    ([[-1e-4, -2e-4], [-3e-4, -1e-4]], False),
    ([[1e-4, np.nan], [-3e-4, 1e-4]], False),
])  # fmt: skip
def test_a_map_of_two_keys_has_colours_about_zero_and_the_border_of_slewing(mapped, growth, bordered):
    axes, bar = mapped(map_of(growth))
    mesh = axes.collections[0]
    assert mesh.get_clim() == pytest.approx((-1.08, 1.08))
    assert np.ma.filled(mesh.get_array().astype(float), np.nan) == pytest.approx(3600 * np.array(growth), nan_ok=True)
    assert (len(axes.collections) > 1) is bordered
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("hawser.length, unit", "wind.speed, unit")
    assert bar.get_ylabel() == "growth of the slowest motion, 1/h (red: slewing)"
