"""How frequencies of a band are added, of made-up databases, and what the end of a run prints."""

import io
from contextlib import nullcontext
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.database.integrity import DamagedError
from hakobune.meshing.quality import Finding
from hakobune.pipelines.solve import adaptive, checking, report

OMEGA = np.array([0.4, 0.5, 0.6])
COEFFICIENTS = ["added_mass", "radiation_damping"]


def scene(first=0.4, last=1.6, accuracy=0.01):
    return SimpleNamespace(waves=SimpleNamespace(band=SimpleNamespace(first=first, last=last)), accuracy=accuracy)


def console():
    return Console(file=io.StringIO(), width=200)


def test_what_a_tolerance_controls_is_coefficients_and_excitation_or_one_smooth_quantity():
    assert adaptive.controlled(["rao", *COEFFICIENTS, "excitation_force"]) == [*COEFFICIENTS, "excitation_force"]
    assert adaptive.controlled(["kochin_diffraction", "drift_force_fixed"]) == ["drift_force_fixed"]
    assert adaptive.controlled(["rao"]) == []


@pytest.mark.parametrize(("count", "names", "wanted"), [
    (12, COEFFICIENTS, 2.2 * 0.3), (11, COEFFICIENTS, np.inf), (2, ["rao"], 0.0)])  # fmt: skip
def test_the_error_of_a_band_is_the_largest_at_400_places_from_twelve_frequencies_on(count, names, wanted):
    asked = []

    def largest_error(places, names):
        asked.append((places, names))
        return np.array([0.1, 0.3, 0.2])

    known = SimpleNamespace(quantities=names, omega=np.append(np.linspace(0.4, 1.6, count), [0.3, 1.7]),
                            largest_error=largest_error)  # fmt: skip
    places, error = adaptive._estimated(scene(), known)
    assert error == pytest.approx(wanted) and places == pytest.approx(np.linspace(0.4, 1.6, 400))
    assert len(asked) == (wanted not in (0.0, np.inf)) and all(names == COEFFICIENTS for _, names in asked)


@pytest.mark.parametrize(("inside", "error", "count"), [
    (3, np.inf, 9), (11, np.inf, 1), (12, 0.11, 3), (12, 0.09, 1), (20, 0.011, 1)])  # fmt: skip
def test_many_frequencies_are_added_far_from_the_tolerance_and_one_at_a_time_near_it(monkeypatch, inside, error, count):
    """Twelve first; then three while the error is more than ten times the tolerance of 1 %"""
    given = []
    monkeypatch.setattr(adaptive, "Abscissa", lambda w: ("stored", w))
    monkeypatch.setattr(
        adaptive, "chosen", lambda stored, open_, n: given.append((stored, open_, n)) or np.array([2, 0])
    )
    known = SimpleNamespace(omega=np.linspace(0.4, 1.6, inside), depth=20.0, gravity=9.8, length=50.0)
    places = np.array([0.5, 0.7, 0.9])
    monkeypatch.setattr(adaptive, "abscissa", lambda w, *water: given.append((w, water)) or (w,))
    found = adaptive._next(scene(), known, places, error)
    assert list(found) == [0.9, 0.5] and given[-1][2] == count
    assert given[-1][0][1] is known.omega and given[-1][1][0] is places
    assert [water for _, water in given[:2]] == [(20.0, 9.8, 50.0)] * 2


def resonance(omega=0.55, damping=0.1, error=0.0, peak=2.0):
    return SimpleNamespace(omega=omega, damping=damping, error=error, peak=peak)


@pytest.mark.parametrize(
    ("one", "names", "error", "solved"),
    [
        (resonance(), ("rao",), 0.0, False),
        (resonance(damping=0.0199), ("rao",), 0.0, True), (resonance(damping=0.0201), ("rao",), 0.0, False),
        (resonance(error=0.0201), ("rao",), 0.0, True), (resonance(error=0.0199), ("rao",), 0.0, False),
        (resonance(damping=0.0199), (), 0.0, False),
        (resonance(0.5 * 1.0019, 0.01), ("rao",), 0.0, False), (resonance(0.5 * 1.0021, 0.01), ("rao",), 0.0, True),
        (resonance(), ("rao", "drift_force"), 0.00201, True), (resonance(), ("rao", "drift_force"), 0.00199, False),
        (resonance(), ("rao",), 0.00201, False),
        (resonance(0.5 / 1.049), ("rao", "drift_force"), 0.01, False),
        (resonance(0.5 / 1.051), ("rao", "drift_force"), 0.01, True),
    ],
)  # fmt: skip
def test_a_resonance_is_solved_where_it_is_sharp_unsure_or_amplifies_errors_of_drift(
    monkeypatch, one, names, error, solved
):
    """Damping below 2 %; an error above 1 % of the peak; farther than 0.2 % from what is stored; for drift, farther
    than half its width (of 10 %) and an error above 2 · 10 % · 1 %"""
    db = SimpleNamespace(names=names, omega=OMEGA, bodies_reader="reader")
    monkeypatch.setattr(adaptive, "resonances", lambda reader: [resonance(0.4, 0.01), one, resonance(3.0, 0.001)]
                        if reader == "reader" else [])  # fmt: skip
    found = adaptive._unseen(scene(), db, error)
    expected = [one.omega] if solved else [3.0] if "rao" in names else []
    assert list(found) == expected


@pytest.mark.parametrize(
    ("names", "error", "says"),
    [
        (
            (*COEFFICIENTS, "excitation_force"),
            0.0123,
            ": estimated error of coefficients and forces between them 1.2 % (tolerance 1 %)",
        ),
        (
            (*COEFFICIENTS, "rao"),
            0.005,
            ": estimated error of coefficients between them 0.5 % (tolerance 1 %), and more for motions",
        ),
        ((*COEFFICIENTS, "rao", "drift_force"), 0.005, "(tolerance 1 %), and more for motions and drift"),
        (
            (*COEFFICIENTS,),
            np.inf,
            "3 frequencies from 0.4 to 1.6 rad/s, too few to estimate the error between frequencies",
        ),
    ],
)
def test_the_error_of_a_band_is_told_in_per_cent_beside_its_tolerance(names, error, says):
    said = adaptive._text(scene(), SimpleNamespace(omega=np.append(OMEGA, 2.0), names=names), error)
    assert said.endswith(says) and said.startswith("3 frequencies from 0.4 to 1.6 rad/s")


def test_missing_frequencies_are_looked_for_with_what_is_known(monkeypatch):
    seen = []
    monkeypatch.setattr(adaptive, "between", lambda db: "known")
    monkeypatch.setattr(adaptive, "_estimated", lambda *given: seen.append(given) or ("places", 0.02))
    monkeypatch.setattr(adaptive, "_next", lambda *given: seen.append(given) or "next")
    monkeypatch.setattr(adaptive, "_unseen", lambda *given: seen.append(given) or "unseen")
    of, db = scene(), SimpleNamespace(omega=OMEGA)
    assert adaptive._missing(of, db) == (0.02, "next") and seen == [(of, "known"), (of, "known", "places", 0.02)]
    of.accuracy = 0.02
    assert adaptive._missing(of, db) == (0.02, "unseen") and seen[3] == (of, db, 0.02)


def test_a_band_is_told_as_it_fills(monkeypatch):
    monkeypatch.setattr(adaptive, "open_database", lambda file: SimpleNamespace(omega=OMEGA))
    monkeypatch.setattr(adaptive, "_missing", lambda scene, db: (0.5, ()))
    text = "error [of] a long text " + 300 * "x"
    monkeypatch.setattr(adaptive, "_text", lambda scene, db, error: text)
    out, failed = console(), SimpleNamespace(exit_status=1)
    assert adaptive.filled_band(scene(), "a", lambda file: failed, None, out) is failed and not out.file.getvalue()
    made = adaptive.filled_band(scene(), "a", lambda file: Done(), None, out)
    assert out.file.getvalue() == text + "\n"
    assert made.remarks == (
        "so",
        f"FAILS: {text}; the tolerance is not reached; give a larger tolerance, or more panels",
    )


@dataclass(frozen=True)
class Done:
    exit_status: int = 0
    remarks: tuple = ("so",)


def base(**more):
    return SimpleNamespace(**{"names": ("rao",), "bodies": (), "modes": (), "omega": OMEGA} | more)


def test_a_run_ends_with_what_is_stored_and_how_it_goes_on(monkeypatch):
    monkeypatch.setattr(report, "body_table", lambda db: "the body")
    monkeypatch.setattr(report, "checked", lambda db: ["one"])
    monkeypatch.setattr(report, "checks_table", lambda checks: f"checks {checks[0]}")
    monkeypatch.setattr(report, "resonances_of", lambda db: ["at 9 s"])
    monkeypatch.setattr(report, "beyond_gap_water", lambda db: ())
    monkeypatch.setattr(report, "failures", lambda outcome, db, own: ["FAILS: it"] if own else [])

    def ended(own=False, **more):
        given = {"stored": 3, "total": 4, "path": "b.h5", "exit_status": 0, "solved": 2, "jobs": 1, "remarks": ("so",)}
        out = console()
        status = report.print_outcome(out, SimpleNamespace(**given | more), base(), own)
        return status, [line.strip() for line in out.file.getvalue().splitlines() if line.strip()]

    told = ["the body", "checks one", "note: so", "note: at 9 s", "3 of 4 frequencies stored in b.h5, 2 by this run"]
    assert ended() == (0, told)
    assert ended(exit_status=1) == (1, [*told[:4], told[4] + "; run the same command to continue"])
    assert ended(jobs=0)[1][-1] == "3 of 4 frequencies stored in b.h5, nothing was left to compute"
    assert ended(stored=0)[1][:2] == ["the body", "note: so"]
    status, lines = ended(True)
    assert status == 1 and "FAILS: it" in lines[-2] and ended(True, exit_status=130)[0] == 130


@pytest.mark.parametrize("more", [{"bodies": (1,)}, {"modes": (1,)}, {"names": ()}, {"omega": np.zeros(0)}])
def test_resonances_are_told_of_one_rigid_free_body_with_frequencies(monkeypatch, more):
    monkeypatch.setattr(report, "resonances", lambda body: f"of {body}")
    monkeypatch.setattr(report, "resonance_lines", lambda *given: [given])

    class Known(dict):
        names, bodies, modes, omega, reader = ("rao",), (), (), OMEGA, "body"

    db = Known(rao="rao")
    assert report.resonances_of(db) == [("of body", OMEGA, "rao")]
    for name, value in more.items():
        setattr(db, name, value)
    assert report.resonances_of(db) == []


def test_resonances_of_unknown_numbers_are_not_told():
    class Unknown(SimpleNamespace):
        @property
        def reader(self):
            raise BetweenError("unknown")

    assert report.resonances_of(Unknown(**vars(base()))) == []


@pytest.mark.parametrize(("panels", "shapes", "given"), [
    (None, ["box"], False), (100, ["box"], True), (None, ["box", "mesh"], True)])  # fmt: skip
def test_panels_are_given_as_a_number_or_by_a_file(panels, shapes, given):
    bodies = [SimpleNamespace(shape=shape) for shape in shapes]
    assert report.gives_panels(SimpleNamespace(panels=panels, bodies=bodies)) is given


@pytest.mark.parametrize(("tolerance", "limit"), [({"tolerance": 0.03}, 0.03), ({}, 0.01)])
def test_damping_is_checked_beside_the_stored_checks(monkeypatch, tolerance, limit):
    monkeypatch.setattr(report, "damping_errors", lambda db: np.array([0.0, 0.02, 0.04]))
    db = base(
        attributes=tolerance, checks=lambda: {"residual": np.array([0, 2e-6, 0.0]), "energy": np.array([0.02, 0, 0])}
    )
    residual, energy, damping = report.checked(db)
    assert (residual.name, residual.limit, residual.exceeding) == ("residual", 1e-6, 1)
    assert (energy.limit, energy.exceeding, energy.omega) == (limit, int(limit < 0.02), 0.4)
    assert (damping.name, damping.largest, damping.omega, damping.limit) == ("damping", 0.04, 0.6, limit)
    assert damping.exceeding == (1 if limit > 0.02 else 2)


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ({}, [("heave", "9.5", "s"), ("roll", "~12.35", "s")]), ({"bodies": (1,)}, []), ({"modes": (1,)}, []),
        ({"names": ("rao",)}, []), ({"omega": np.zeros(0)}, []), ({"inertia": None}, []),
    ],
)  # fmt: skip
def test_natural_periods_are_marked_outside_the_band(monkeypatch, more, told):
    found = SimpleNamespace(period=[1, 2, 9.5, 12.3456, np.nan, 7], inside=[True, True, True, False, True, True],
                            names=["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"])  # fmt: skip
    monkeypatch.setattr(report, "natural_periods", lambda reader: found)
    reader = SimpleNamespace(inertia=more.pop("inertia", 1))
    db = base(**{"names": ("added_mass",), "reader": reader} | more)
    assert list(report._free_periods(db)) == [(f"natural period, {name}", text, unit) for name, text, unit in told]


@pytest.mark.parametrize("error", [BetweenError("few"), np.linalg.LinAlgError("singular")])
def test_natural_periods_that_cannot_be_found_are_left_out(monkeypatch, error):
    def fail(reader):
        raise error

    monkeypatch.setattr(report, "natural_periods", fail)
    assert list(report._free_periods(base(names=("added_mass",), reader=SimpleNamespace(inertia=1)))) == []


def test_the_table_of_several_bodies_tells_where_each_turns_and_which_is_fixed(monkeypatch):
    def body(number, name):
        whole = SimpleNamespace(
            bodies=[
                SimpleNamespace(rotation_center=(1.0, 2.0, -0.0), heading=np.pi / 6, fixed=False),
                SimpleNamespace(rotation_center=(0.0, 0.0, 3.0), heading=0.0, fixed=True),
            ]
        )
        return SimpleNamespace(
            name=name, number=number, database=whole, bodies=(1, 2), modes=(), dimensions={"radius": 5.0},
            water_depth=20.0, density=1000.0, displaced_volume=1234.5678, mass=9e5, center_of_mass=(0, 0, 1),
            center_of_buoyancy=(0, 0, -1), waterplane_area=78.54, transverse_metacentric_height=1.23456,
            longitudinal_metacentric_height=2.0,
        )  # fmt: skip

    monkeypatch.setattr(report, "each_body", lambda db: [body(0, "ship"), body(1, "pier")])
    table = report.body_table(SimpleNamespace(bodies=(1, 2)))
    assert table.title == "bodies at rest" and [c.header for c in table.columns] == ["quantity", "ship", "pier", "unit"]
    rows = {row[0]: row[1:] for row in zip(*(column.cells for column in table.columns), strict=True)}
    assert rows == {
        "radius": ("5", "5", "m"), "water depth": ("20", "20", "m"), "displaced mass": ("1234.57", "1234.57", "t"),
        "mass": ("900", "900", "t"), "center of gravity": ("0, 0, 1", "0, 0, 1", "m"),
        "center of buoyancy": ("0, 0, -1", "0, 0, -1", "m"), "rotation center": ("1, 2, 0", "0, 0, 3", "m"),
        "heading": ("30", "0", "°"), "moves": ("yes", "no, fixed", ""), "waterplane": ("78.54", "78.54", "m²"),
        "GM transverse": ("1.235", "–", "m"), "GM longitudinal": ("2", "–", "m"),
    }  # fmt: skip
    monkeypatch.setattr(report, "each_body", lambda db: [])
    assert report.body_table(SimpleNamespace(bodies=())).title == "body at rest"


def of_check(monkeypatch, complete=True, omega=OMEGA, **parts):
    """Status and lines of `check` of a database whose parts are set by hand"""
    found = {"_findings": [], "_scene_findings": [], "_broken": [], "checked": [], "resonances_of": [], "_of_pairs": []}
    found |= {name: value for name, value in parts.items() if name != "gaps"}
    db = SimpleNamespace(omega=omega, complete=complete, attributes={}, rows=np.array([True, True, complete]))
    for name, value in found.items():
        monkeypatch.setattr(checking, name, lambda db, value=value: value)
    monkeypatch.setattr(checking, "open_database", lambda path: db)
    monkeypatch.setattr(checking, "gaps_of", lambda db: SimpleNamespace(not_known=lambda: parts.get("gaps", ())))
    monkeypatch.setattr(checking, "checks_table", lambda checks: f"{len(checks)} checks")
    out = console()
    status = checking.check("b.h5", out)
    return status, [line.strip() for line in out.file.getvalue().splitlines() if line.strip()]


def test_check_tells_findings_notes_laws_and_what_is_missing_with_its_status(monkeypatch):
    assert of_check(monkeypatch)[0] == 0
    warned = of_check(monkeypatch, _findings=[Finding("warning", "long panels")], resonances_of=["roll at 12 s"])
    assert warned[0] == 0 and any("warning: long panels" in line for line in warned[1])
    assert any("note: roll at 12 s" in line for line in warned[1])
    for part in ("_findings", "_scene_findings", "_broken"):
        status, lines = of_check(monkeypatch, **{part: [Finding("error", "open hull")]})
        assert status == 1 and any("FAILS: open hull" in line for line in lines), part
    status, lines = of_check(monkeypatch, gaps=["a gap is not known"])
    assert status == 1 and any("FAILS: a gap is not known" in line for line in lines)
    bad = report.Check("energy", 0.034, 0.5, 0.01, 2)
    status, lines = of_check(monkeypatch, checked=[report.Check("residual", 1e-9, 0.4, 1e-6, 0), bad])
    assert status == 1 and "2 checks" in lines
    assert any(
        "energy, waves carried away, is 0.034 at ω = 0.5 rad/s, 2 of 3 frequencies above 0.01" in x for x in lines
    )
    assert not any("residual, linear system" in line for line in lines)
    _, lines = of_check(monkeypatch, checked=[report.Check("energy", 0.010034, 0.5, 0.01, 1)])
    assert any("is 0.01003 at ω" in line for line in lines)  # not 0.01, above 0.01
    status, lines = of_check(monkeypatch, complete=False)
    assert status == 1 and any("2 of 3 frequencies are stored; run the command again" in line for line in lines)
    status, lines = of_check(monkeypatch, omega=np.zeros(0), checked=[bad])
    assert status == 0 and not any("checks" in line for line in lines)


def test_damage_of_a_file_is_a_finding_and_repair_tells_what_it_marks(monkeypatch, tmp_path):
    def damaged(path):
        raise DamagedError("identifying data are damaged")

    monkeypatch.setattr(checking, "open_database", damaged)
    out = console()
    assert checking.check("b.h5", out) == 1 and "FAILS: identifying data are damaged" in out.file.getvalue()
    path, kept = tmp_path / "b.h5", []
    path.write_bytes(b"")
    monkeypatch.setattr(checking, "keep_room", kept.append)
    monkeypatch.setattr(checking, "opened", lambda path, mode: nullcontext(mode))
    monkeypatch.setattr(checking, "repair", lambda file: {"rao": 2, "added_mass": 1})
    out = console()
    assert checking.check(path, out, repair=True) == 1
    assert "these frequencies are now marked as unsolved: rao (2), added_mass (1); repeat the" in out.file.getvalue()
    monkeypatch.setattr(checking, "repair", lambda file: {})
    assert checking._repaired(path) == f"{path}: nothing is damaged" and kept == [path, path]


@pytest.mark.parametrize(("key", "stored"), [("depth", 21.0), ("density", 1000.0), ("gravity", 9.8)])
def test_a_scene_of_other_water_than_its_results_is_told(monkeypatch, key, stored):
    water = {"depth": 20.0, "density": 1025.0, "gravity": 9.80665}
    monkeypatch.setattr(checking, "typed", lambda raw, *_: SimpleNamespace(water=SimpleNamespace(**water)))
    db = SimpleNamespace(header=SimpleNamespace(scene="a = 1"), water_depth=20.0, density=1025.0, gravity=9.80665)
    assert list(checking._scene_findings(db)) == []
    setattr(db, "water_depth" if key == "depth" else key, stored)
    (said,) = checking._scene_findings(db)
    assert said.severity == "error"
    says = f"water.{key} is {water[key]:g} in its scene, but its results are for {stored:g}; solve it again with"
    assert said.text == f"{says} --fresh"
    db.header.scene = "a ="
    (said,) = checking._scene_findings(db)
    assert said.text.startswith("the text of its scene cannot be read: ") and said.severity == "error"
    db.header.scene = ""
    assert list(checking._scene_findings(db)) == []


@pytest.mark.parametrize(
    ("method", "names", "on"),
    [
        ("panel", (), True),
        ("contour", (), False),
        ("contour", ("pressure",), True),
        ("else", (), True),
        (None, (), True),
    ],
)
def test_panels_count_where_a_method_or_a_result_used_them(method, names, on):
    assert checking._on_panels(SimpleNamespace(attributes={"method": method}, names=names)) is on


@pytest.mark.parametrize(("panels", "waves", "stands", "wanted"), [
    (True, True, False, ("mesh", 20.0, 2 * np.pi / 0.25, "lid")), (True, False, False, ("mesh", 20.0, "lid")),
    (False, True, False, ("mesh", np.inf)), (False, True, True, ("mesh", 20.0))])  # fmt: skip
def test_a_mesh_is_judged_for_the_shortest_stored_wave(monkeypatch, panels, waves, stands, wanted):
    class Stored(dict):
        mesh, water_depth, lid, omega = "mesh", 20.0, "lid", OMEGA if waves else np.zeros(0)

    monkeypatch.setattr(checking, "_on_panels", lambda db: panels)
    monkeypatch.setattr(checking, "stands", lambda mesh, depth: stands)
    monkeypatch.setattr(checking, "findings", lambda mesh, depth, *wave, **lid: (mesh, depth, *wave, *lid.values()))
    assert checking._findings(Stored(wavenumber=np.array([0.05, 0.25]))) == wanted
