"""`hakobune earthquake` at linear fenders: periods, course, pictures, and every limit from both sides."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import hakobune
from hakobune.bem.time_domain import memory as of_memory
from hakobune.mooring.dolphins.earthquake import natural
from hakobune.mooring.dolphins.methods import stiffnesses
from hakobune.pipelines.cli import main
from hakobune.pipelines.earthquake import study as studies

M, A, N, K = 51250.0, 15000.0, 2000.0, 3000.0  # t, t, kN s/m, kN/m: three fenders of 1000 kN/m on each side
G = 9.80665
STUDY = f"""
motion = "sway"
[body]
mass = {M}
added_mass = {A}
damping = {N}
[fender]
table = "fender.csv"
height = 2.0
count = 3
"""
SPECTRUM = "[spectrum]\nperiods = [0.1, 10.0, 30.0]\nacceleration = [2.0, 0.1, 0.01]\n"
LINEAR = "strain,reaction_kN\n0,0\n0.25,500\n0.5,1000\n"
SOFTENING = "strain,reaction_kN\n0,0\n0.125,250\n0.25,500\n0.375,600\n0.5,700\n"


def written(folder, text, fender=LINEAR):
    (folder / "fender.csv").write_text(fender)
    (folder / "quake.toml").write_text(text)
    return folder / "quake.toml"


def by_seismic(deflection, k=K):
    """Coefficient whose force presses springs so far"""
    return k * deflection / (M * G)


def test_the_period_is_that_of_the_first_slope_and_of_the_secant_where_fenders_are_pressed_most(tmp_path, asked):
    """T = 2π √((M + a)/k): 3000 kN/m at first; pressed by 1 m they react with 3 · 700 kN, a secant of 2100 kN/m, whose
    normalised reaction k/(ω²M) |−ω²(M + a) + iωN| / |k − ω²(M + a) + iωN| stands in a column of its own"""
    secant = 2100.0
    path = written(tmp_path, f"coefficient = {by_seismic(1.0, secant):.9f}\n" + STUDY, SOFTENING)
    found = hakobune.earthquake(path)
    k = np.array([K, secant])
    assert list(found.labels["stiffness"].values) == ["first slope", "1 m"]
    assert found["stiffness.value"] == pytest.approx(1e3 * k, rel=1e-5)
    assert found["stiffness.period"] == pytest.approx(2 * np.pi * np.sqrt((M + A) / k), rel=1e-5)
    assert found["method.deflection"][0] == pytest.approx(1.0, rel=1e-5)
    assert found["method.over_weight"][0] == pytest.approx(by_seismic(1.0, secant), rel=1e-6)
    T = found.labels["ground_period"].values[:, None]
    assert list(T[:, 0]) == [0.2, 0.5, 1, 2, 3, 5, 10, 20]
    w = 2 * np.pi / T
    water = -(w**2) * (M + A) + 1j * w * N
    assert found["normalised"] == pytest.approx(k / (w**2 * M) * np.abs(water) / np.abs(k + water), rel=1e-4)


@pytest.mark.parametrize("share, status", [(0.995, 0), (1.005, 1)])
def test_fenders_fail_beyond_their_allowable_strain(tmp_path, asked, share, status):
    """Allowed to 40 % of 2 m"""
    text = f"coefficient = {by_seismic(0.8 * share):.9f}\n" + STUDY + "rated_strain = 0.35\nallowable_strain = 0.4\n"
    _, said = asked("earthquake", written(tmp_path, text), status=status)
    words = "the fenders are compressed by 40.2 % of their height; allowable 40 %; use more or larger fenders"
    assert (f"FAILS: seismic coefficient {by_seismic(0.8 * share):g}: {words}" in said) is bool(status)


@pytest.mark.parametrize("share, status", [(0.995, 0), (1.005, 1)])
def test_fenders_fail_beyond_the_end_of_their_table(tmp_path, share, status):
    """3 · 1000 kN of it; each of the three is told with what it has to bear"""
    path = written(tmp_path, f"coefficient = {by_seismic(share):.9f}\n" + STUDY)
    found = hakobune.earthquake(path)
    assert found.status == status == len(found.fails)
    assert (
        not status or ("1005 kN act on it, but its table ends at 1000 kN; use more or larger fenders") in found.fails[0]
    )
    assert np.isnan(found["method.deflection"][0]) == bool(status)


def test_the_course_of_a_body_shaken_by_a_record_obeys_its_equation(tmp_path, asked, pictures):
    """(M + a) η̈ + N η̇ + k u = 0 of the body in space η, with u = η − y of the ground; reaction k u on the dolphins
    towards +, deflection |u|; y is the record twice integrated with a line of acceleration added so that it ends at
    rest"""
    t = np.arange(0.0, 20.0001, 0.01)
    a = 0.08 * np.sin(2 * np.pi * t / 10.0) ** 3
    rows = "".join(f"{x:.2f},{y:.9g}\n" for x, y in zip(t, a, strict=True))
    (tmp_path / "record.csv").write_text("time_s,acceleration_m_s2\n" + rows)
    path = written(tmp_path, STUDY + '[record]\nfile = "record.csv"\nafter = 30.0\nscale = 2.0\n')
    asked("earthquake", path, "--plot", tmp_path / "p.png")
    found = hakobune.earthquake(path)
    course = {key: found[f"course.{key}"] for key in ("ground_acceleration", "deflection", "reaction")}
    time, y, body = found.labels["time"].values, found["course.ground"], found["course.body"]
    assert np.diff(time) == pytest.approx(np.full(5000, 0.01)) and time[-1] == pytest.approx(50.0)
    # the line through first and last that takes velocity and way at the end to 0
    T, speed, way = t[-1], np.trapezoid(2 * a, t), np.trapezoid((t[-1] - t) * 2 * a, t)
    c = np.linalg.solve([[T, T / 2], [T**2 / 2, T**2 / 6]], [-speed, -way])
    shaken = 2 * a + c[0] + c[1] * t / T
    assert course["ground_acceleration"][: len(t)] == pytest.approx(shaken, abs=1e-6)
    assert np.all(course["ground_acceleration"][len(t) :] == 0) and np.all(np.abs(y[len(t) :]) < 1e-9)
    velocity = np.concatenate([[0], np.cumsum(0.005 * (shaken[1:] + shaken[:-1]))])
    moved = np.concatenate([[0], np.cumsum(0.005 * (velocity[1:] + velocity[:-1]))])
    assert y[: len(t)] == pytest.approx(moved, abs=1e-4 * np.abs(moved).max())
    u = body - y
    assert course["reaction"] == pytest.approx(1e3 * K * u, abs=1e-4 * np.abs(course["reaction"]).max())
    assert course["deflection"] == pytest.approx(np.abs(u), abs=1e-6)
    speed = np.gradient(body, 0.01)
    left = (M + A) * np.gradient(speed, 0.01) + N * speed + K * u
    assert np.abs(left[5:-5]).max() < 0.01 * np.abs(K * u).max()
    assert found["method[record in time].acceleration"] == pytest.approx(np.abs(shaken).max(), rel=1e-6)
    assert found["method[record in time].reaction"] == pytest.approx(1e3 * K * np.abs(u).max(), rel=1e-4)
    assert found["method[record in time].deflection"] == pytest.approx(np.abs(u).max(), rel=1e-6)
    told = [found["ground.largest_acceleration"], found["ground.largest_displacement"],
            found["course.largest_displacement"], found["ground.added_first"], found["ground.added_last"]]  # fmt: skip
    by_hand = [np.abs(shaken).max(), np.abs(y).max(), np.abs(body).max(), c[0], c[0] + c[1]]
    assert told == pytest.approx(by_hand, rel=1e-3)
    first, places, force = pictures[0].axes
    assert [axis.get_ylabel() for axis in pictures[0].axes] == [
        "reaction/(ω² y M)", "displacement, m", "reaction on the dolphins, kN"]  # fmt: skip
    assert (first.get_xlabel(), force.get_xlabel()) == ("period of the ground, s", "time, s")
    T, ratio = first.lines[0].get_data()
    w = 2 * np.pi / T
    water = -(w**2) * (M + A) + 1j * w * N
    assert ratio == pytest.approx(K / (w**2 * M) * np.abs(water) / np.abs(K + water), rel=1e-6)
    assert T[0] == pytest.approx(0.1) and T[-1] == pytest.approx(50.0)
    drawn = {line.get_label(): line.get_ydata() for line in places.lines}
    assert drawn["ground"] == pytest.approx(y, abs=1e-6) and drawn["body"] == pytest.approx(body, abs=1e-6)
    assert force.lines[0].get_ydata() == pytest.approx(K * u, abs=1e-3 * np.abs(K * u).max())


@pytest.mark.parametrize(
    "text, says",
    [
        ("coefficient = 2.0", None),
        ("coefficient = 2.001", "coefficient is 2.001; allowed: above 0, at most 2"),
        ("coefficient = 0.0", "coefficient is 0; allowed: above 0, at most 2"),
        ("clearance = 5.0", None),
        ("clearance = 5.01", "fender.clearance is 5.01 m; allowed: 0 to 5"),
        ("clearance = -0.01", "fender.clearance is -0.01 m; allowed: 0 to 5"),
        ("count = 1000", None),
        ("count = 1001", "fender.count is 1001; allowed: 1 to 1000 on each side"),
        ("damping_ratio = 0.5", None),
        ("damping_ratio = 0.51", "spectrum.damping_ratio is 0.51; allowed: above 0, at most 0.5"),
        ("acceleration = [50.0, 0.1, 0.01]", None),
        ("acceleration = [50.1, 0.1, 0.01]", "spectrum.acceleration has 50.1; allowed: above 0, at most 50 m/s²"),
        ("acceleration = [0.1, 0.0, 0.01]", "spectrum.acceleration has 0; allowed"),
        (
            "acceleration = [0.1, 0.1]",
            "spectrum has 3 periods and 2 accelerations; allowed: the same number, at least 2",
        ),
        ("periods = [10.0, 10.0, 30.0]", "spectrum.periods are not increasing; allowed: s, above 0, increasing"),
        ("periods = [0.0, 10.0, 30.0]", "spectrum.periods are not increasing; allowed: s, above 0, increasing"),
        ("damping = -1.0", "body.damping is -1; allowed: 0 or more, finite"),
        ("added_mass = -1.0", "body.added_mass is -1; allowed: 0 or more, finite"),
        ("mass = 0.0", "body.mass is 0; allowed: above 0, finite"),
        ("added_mass = 0.0", None),
        ("rule = 1", "rule"),
    ],
)
def test_a_study_is_taken_up_to_its_limits_and_refused_beyond(tmp_path, capsys, text, says):
    key = text.split(" =")[0]
    study = f"coefficient = 0.001\n{STUDY}clearance = 0.0\n{SPECTRUM}damping_ratio = 0.05\n"
    lines = [line for line in study.splitlines() if line.split(" =")[0] != key]
    place = {"coefficient": 0, "rule": 0, "clearance": "[fender]", "count": "[fender]", "damping_ratio": "[spectrum]",
             "acceleration": "[spectrum]", "periods": "[spectrum]"}.get(key, "[body]")  # fmt: skip
    lines.insert(0 if place == 0 else lines.index(place) + 1, text)
    status = main(["earthquake", str(written(tmp_path, "\n".join(lines)))])
    told = capsys.readouterr().err
    assert (status == 2) is (says is not None), told
    assert says is None or (says in told and told.count("\n") == 1)


@pytest.mark.parametrize("last, status", [(30.0, 0), (29.0, 1)])
def test_a_spectrum_that_ends_below_the_period_of_the_body_is_told(tmp_path, asked, last, status):
    """It swings with 2π √(66250/3000) = 29.5 s"""
    text = STUDY + SPECTRUM.replace("30.0]", f"{last}]")
    _, said = asked("earthquake", written(tmp_path, text), status=status)
    assert (
        "the natural period on the fenders is 29.5 s, and the spectrum ends at 29 s; extend the spectrum" in said
    ) is bool(status)


@pytest.mark.parametrize("after, says", [(600.0, None), (601.0, "record.after is 601 s; allowed: 0 to 600"),
                                         (-1.0, "record.after is -1 s; allowed: 0 to 600"), (0.0, None)])  # fmt: skip
def test_the_ground_stands_still_for_ten_minutes_at_most(tmp_path, capsys, after, says):
    t = np.arange(0.0, 60.0, 0.5)
    rows = "".join(f"{x:g},{y:g}\n" for x, y in zip(t, np.sin(t), strict=True))
    (tmp_path / "record.csv").write_text("time_s,acceleration_gal\n" + rows)
    path = written(tmp_path, STUDY + f'[record]\nfile = "record.csv"\nafter = {after}\n')
    assert (main(["earthquake", str(path)]) == 2) is (says is not None)
    assert says is None or says in capsys.readouterr().err


def test_a_course_is_asked_for_with_a_record_alone(tmp_path, capsys):
    path = written(tmp_path, "coefficient = 0.001\n" + STUDY)
    assert main(["earthquake", str(path), "--output", str(tmp_path / "c.csv")]) == 2
    assert (
        "--output is a time series, which needs [record] in the study; give [record], or an .h5 file"
    ) in capsys.readouterr().err
    assert main(["earthquake", str(written(tmp_path, STUDY))]) == 2
    assert "the earthquake is not defined; give one or more of" in capsys.readouterr().err
    both = "coefficient = 0.001\n" + STUDY + '[rule]\nrule = "A"\nfactors = { coefficient = 0.2 }\n'
    assert main(["earthquake", str(written(tmp_path, both))]) == 2
    assert "rule and coefficient are both given; give one of them" in capsys.readouterr().err


@pytest.mark.parametrize("deflection, secant", [(np.nan, False), (0.99e-3, False), (1.01e-3, True), (0.5, True)])
def test_stiffnesses_are_of_the_first_thousandth_and_of_what_is_deflected(deflection, secant):
    """Four fenders of 2 m with F = x³: a first slope of 3 · 0.002², a secant of x², from a thousandth of 2 m on; of a
    mass of 5 the periods are 2π √(5/k)"""

    def loading(x):
        return x**3

    loading.slope = lambda x: 3 * x**2
    fenders = SimpleNamespace(fender=SimpleNamespace(loading=loading, limit=2.0), count=4)
    rows = [SimpleNamespace(deflection=np.nan), SimpleNamespace(deflection=2 * deflection)]
    made = stiffnesses(SimpleNamespace(fenders=fenders, floater=floating(5.0, lambda omega: 0.0)), rows)
    expected = {"first slope": 4 * 3 * 0.002**2}
    if secant:
        expected[f"{2 * deflection:.3g} m"] = 4 * (2 * deflection) ** 2
    assert list(made) == list(expected)
    for name, k in expected.items():
        assert made[name] == pytest.approx((k, 2 * math.pi * math.sqrt(5.0 / k)))


def test_periods_are_of_the_added_mass_at_their_own_frequency():
    """k = ω² (M + A(ω)) with A = 1 + 2 ω² of a mass of 3 and a spring of 8: 2 ω⁴ + 4 ω² = 8, ω² = √5 − 1"""
    period = 2 * math.pi / natural(floating(3.0, lambda omega: 1 + 2 * np.square(omega)), 8.0)
    assert period == pytest.approx(2 * math.pi / math.sqrt(math.sqrt(5) - 1), rel=1e-3)


def floating(mass, added):
    """A body whose water has an added mass over frequency, and no damping"""

    def water(omega):
        return np.atleast_1d(added(omega) + np.zeros(np.shape(omega))), np.zeros(np.size(omega))

    return SimpleNamespace(mass=mass, added_mass=float(added(0.0)), water=water)


@pytest.mark.parametrize("motion, i", [("surge", 0), ("sway", 1)])
def test_a_body_of_a_database_has_its_mass_its_added_mass_and_its_memory_in_the_motion_asked_for(
    motion, i, monkeypatch
):
    """(M + A∞) η̈ + c·x, ẋ = a x + b η̇: of states that decay and turn, B + iω (A∞ − A) by its resolvent"""
    numbers = np.random.default_rng(8)
    arrays = of_memory.MemoryArrays(
        np.array([0.3, 0.1, 0.1]), np.array([0.8]), numbers.normal(size=(6, 3)), numbers.normal(size=(6, 3))
    )
    asked, infinity, mass = [], np.diag(np.arange(1.0, 7.0)), np.diag(np.arange(10.0, 16.0))
    memory = SimpleNamespace(matrices=of_memory.Memory.matrices.fget(SimpleNamespace(arrays=arrays, states=3)),
                             added_mass_infinity=infinity)  # fmt: skip
    db = SimpleNamespace(reader=SimpleNamespace(floating=lambda: SimpleNamespace(inertia=mass)))
    monkeypatch.setattr(studies, "database_of", lambda path: db if path == "box.h5" else None)
    monkeypatch.setattr(of_memory, "memory_of_database", lambda *given: asked.append(given) or memory)
    fender = {"table": "fender.csv", "height": 2.0, "count": 3}
    floater = studies._floater(studies.make_study({"motion": motion, "coefficient": 0.1, "fender": fender}), "box.h5")
    assert asked == [(db, 3e-3, (i,))]
    assert (floater.mass, floater.added_mass, floater.damping) == (10.0 + i, 1.0 + i, 0.0)
    into, out, w = arrays.input[i], arrays.output[i], 0.7
    pair = (w * 1j + 0.1) ** 2 + 0.64
    x = [into[0] / (w * 1j + 0.3), ((w * 1j + 0.1) * into[1] + 0.8 * into[2]) / pair,
         ((w * 1j + 0.1) * into[2] - 0.8 * into[1]) / pair]  # fmt: skip
    added, damping = floater.water(w)
    assert (damping[0], added[0]) == pytest.approx(((out @ x).real, 1.0 + i + (out @ x).imag / w))


@pytest.mark.parametrize("body, database, said", [({"mass": 1.0}, "box.h5", "both are given"), (None, None, "neither")])
def test_a_body_is_given_once(body, database, said):
    fender = {"table": "fender.csv", "height": 2.0, "count": 3}
    raw = {"coefficient": 0.1, "fender": fender} | ({} if body is None else {"body": body})
    with pytest.raises(studies.StudyError, match=rf"\[body\] and --database: {said}"):
        studies._floater(studies.make_study(raw), database)
