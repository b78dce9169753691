"""What a command hands to its function, in SI, and which files it names at its end; what is computed is made up."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import hakobune.pipelines.breakwater.command as of_breakwater
import hakobune.pipelines.damping.command as of_damping
import hakobune.pipelines.earthquake.command as of_earthquake
import hakobune.pipelines.fender.command as of_fender
import hakobune.pipelines.line_dynamics.command as of_line_dynamics
import hakobune.pipelines.lines.line_command as of_line
import hakobune.pipelines.lines.lines_command as of_lines
import hakobune.pipelines.members.command as of_members
import hakobune.pipelines.moor.command as of_moor
import hakobune.pipelines.passing.command as of_passing
import hakobune.pipelines.qtf.command as of_qtf
import hakobune.pipelines.response.command as of_response
import hakobune.pipelines.sections.command as of_sections
import hakobune.pipelines.single_point.command as of_single_point
import hakobune.pipelines.waves.command as of_waves

STATUS = 7
STUDY, H5, PNG = Path("study.toml"), Path("found.h5"), Path("plan.png")


class Made(dict):
    """A result that notes where it is written"""

    def __init__(self, detail=None, **values):
        super().__init__(values)
        self.detail, self.files, self.status = detail, [], STATUS

    def write(self, path):
        self.files.append(path)


class Room:
    """The names that a command calls, replaced; asked : what its function was given; drawn : pictures"""

    def __init__(self, monkeypatch):
        self.patch, self.asked, self.drawn, self.made = monkeypatch, [], [], Made()
        for where in ("hakobune.pipelines.results.tables.printed",):
            monkeypatch.setattr(where, lambda *_: STATUS)
        monkeypatch.setattr("hakobune.pipelines.results.output.write_result", self.write)

    def write(self, result, path):
        result.write(path)

    def found(self, *given, **words):
        self.asked.append((given, words))
        return self.made

    def draw(self, *given, **_):
        self.drawn.append(next(one for one in given if isinstance(one, Path)))

    def of(self, module, **names):
        """Replace `found`, and what a module imports at its head"""
        for name, value in {"printed": lambda *_: STATUS, "write_result": self.write, **names}.items():
            if hasattr(module, name):
                self.patch.setattr(module, name, value)

    def at(self, **names):
        for name, value in names.items():
            self.patch.setattr(f"hakobune.pipelines.{name.replace('__', '.')}", value)


@pytest.fixture
def room(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    Path("study.toml").write_text("name = 'x'\n")
    Path("body.h5").write_bytes(b"")
    return Room(monkeypatch)


def _waves(room):
    room.at(waves__result__waves=room.found, waves__picture__draw=room.draw)
    grid = SimpleNamespace(x=np.array([0.0, 1.0]), y=np.array([5.0]))
    room.made = Made(grid, map=np.array([[1 + 2j, np.nan]]))
    status = of_waves.waves(
        "body.h5", omega=0.8, heading=90.0, fixed=True, width=200.0, at=["3,-4"], output=Path("points.csv"), plot=PNG
    )
    _, words = room.asked[0]
    assert words["heading"] == pytest.approx(math.pi / 2) and (words["fixed"], words["width"]) == (True, 200.0)
    assert words["at"] == [[3.0, -4.0]] and (words["period"], words["omega"]) == (None, 0.8)
    assert Path("points.csv").read_text() == "x_m,y_m,elevation_real,elevation_imag\n0.0,5.0,1.0,2.0\n"
    return status, ["points.csv", "plan.png"]


def _passing(room):
    room.at(passing__result__passing=room.found)
    from hakobune.mooring.motion.given_forces import GivenForce

    given = GivenForce(np.array([0.0, 2.5]), np.array([[1.0] * 6, [2.0] * 6]))
    room.made = Made(SimpleNamespace(in_time=given))
    room.patch.setattr(of_passing, "_draw", lambda detail, plot: room.drawn.append(plot))
    status = of_passing.passing(STUDY, forces=Path("force.csv"), output=H5, plot=PNG)
    rows = [[float(x) for x in line.split(",")] for line in Path("force.csv").read_text().splitlines()[1:]]
    # half a cosine of an eighth of the time from zero and to zero, with one row halfway
    expected = [(0, 0), (0.15625, 0.5), (0.3125, 1), (2.8125, 2), (2.96875, 1), (3.125, 0)]
    assert rows == [pytest.approx([t] + [force] * 6) for t, force in expected]
    assert room.made.files == [H5]
    return status, ["force.csv", "found.h5", "plan.png"]


def _damping(room):
    room.at(damping__result__damping=room.found)
    room.of(of_damping, _draw=lambda result, plot: room.drawn.append(plot))
    status = of_damping.damping(STUDY, mass=2.5, plot=PNG)
    assert room.asked[0][1] == {"mass": 2500.0, "database": None, "motion": None}
    of_damping.damping(STUDY)
    assert room.asked[1][1] == {"mass": None, "database": None, "motion": None}
    return status, ["plan.png"]


def _members(room):
    room.at(members__result__members=room.found)
    room.of(of_members, _draw=lambda result, plot: room.drawn.append(plot))
    return of_members.members(STUDY, plot=PNG), ["plan.png"]


def _fender(room):
    room.at(fender__result__fender=room.found)
    room.of(of_fender, _draw=lambda result, plot: room.drawn.append(plot))
    status = of_fender.fender(family="cell", height=2.0, strain=0.3, energy=900.0, plot=PNG)
    (table,), words = room.asked[0]
    assert (table.family, table.height) == ("cell", 2.0)
    assert words == {"strain": 0.3, "deflection": None, "energy": 9e5}
    return status, ["plan.png"]


def _earthquake(room):
    room.at(earthquake__result__earthquake=room.found, results__records__write_records=room.write)
    room.of(of_earthquake, _draw=lambda result, plot: room.drawn.append(plot))
    room.made = Made(SimpleNamespace(ground=None), **{"course.body": 0})
    status = of_earthquake.earthquake(STUDY, output=H5, plot=PNG)
    assert room.made.files == [H5]
    return status, ["found.h5", "plan.png"]


def _response(room):
    room.at(response__result__response=room.found, response__study__read_response_study=lambda path: (None, ""),
            response__study__files_of=lambda *_: [],
            response__plot__draw=lambda detail, plot: room.drawn.append(plot))  # fmt: skip
    status = of_response.response(STUDY, database=Path("body.h5"), moored=Path("m.toml"), output=H5, plot=PNG)
    assert room.asked[0][0] == (STUDY, Path("body.h5"), Path("m.toml")) and room.made.files == [H5]
    return status, ["written: found.h5, plan.png"]


def _breakwater(room):
    room.at(breakwater__result__breakwater=room.found, breakwater__picture__draw=room.draw,
            breakwater__map_picture__draw_map=room.draw)  # fmt: skip
    room.made = Made((SimpleNamespace(name="b"), None, SimpleNamespace(lee=None), None))
    status = of_breakwater.breakwater(STUDY, output=H5, plot=PNG, database=Path("body.h5"), map_plot=Path("map.png"))
    assert room.drawn == [PNG, Path("map.png")] and room.made.files == [H5]
    return status, ["written: found.h5, plan.png, map.png"]


def _moor(room):
    room.at(moor__result__moor=room.found)
    room.patch.setattr("hakobune.bem.database.open_database", lambda path: "db")
    room.made = Made((SimpleNamespace(), None))
    room.at(moor__plan_picture__draw_plan=room.draw)
    status = of_moor.moor(STUDY, database=Path("body.h5"), output=H5)
    assert room.made.files == [H5] and room.drawn == [Path("found_plan.png")]
    return status, ["written: found.h5, found_plan.png"]


def _single_point(room):
    maps = [1, 2]
    room.made = Made(SimpleNamespace(study=0, point=0, rest=0, run=1, maps=maps))
    room.at(single_point__result__single_point=room.found)
    room.at(single_point__pictures__draw_plan=room.draw, single_point__pictures__draw_run=room.draw,
            single_point__maps__draw=room.draw)  # fmt: skip
    status = of_single_point.single_point(STUDY, output=H5, plot=PNG)
    names = ["plan.png", "found_run.png", "found_slewing_1.png", "found_slewing_2.png"]
    assert list(map(str, room.drawn)) == names and room.made.files == [H5]
    del maps[0]
    room.drawn.clear()
    of_single_point.single_point(STUDY)
    assert list(map(str, room.drawn)) == ["study_run.png", "study_slewing.png"]
    return status, [f"written: {name}" for name in (*names, "found.h5")]


def _line(room):
    room.made = Made((1, 2, 3))
    room.of(of_line, line=room.found, draw=room.draw)
    status = of_line.line_command(H5, PNG, length=3.0)
    assert room.asked == [((), {"length": 3.0})] and room.made.files == [H5] and room.drawn == [PNG]
    return status, ["found.h5", "plan.png"]


def _lines(room):
    room.of(of_lines, read_given=lambda *given: SimpleNamespace(said=given), lines_of=room.found,
            check_asked=lambda *_: None, _moordyn_file=lambda *_: "exported",
            _written=lambda *given: given[1:4])  # fmt: skip
    status = of_lines.lines_command(STUDY, 30.0, H5, PNG, Path("m.dat"), offset=1.0, directions=[0.0])
    (given, words) = room.asked[0]
    assert given[0].said == (STUDY, 30.0) and words == {"offset": 1.0, "directions": [0.0]}
    return status, ["written: found.h5", "written: plan.png", "written: m.dat"]


def _line_dynamics(room):
    room.made = Made((1, 2))
    room.at(line_dynamics__result__line_dynamics=room.found, line_dynamics__picture__draw_run=room.draw)
    status = of_line_dynamics.line_dynamics(STUDY, duration=20.0, tolerance=1e-3, output=H5, plot=PNG)
    words = room.asked[0][1]
    assert (words["duration"], words["tolerance"]) == (20.0, 1e-3) and room.made.files == [H5]
    return status, ["written: found.h5", "written: plan.png"]


def _sections(room):
    room.at(sections__result__sections=room.found)
    status = of_sections.sections(STUDY, output=H5)
    assert room.made.files == [H5]
    with pytest.raises(ValueError, match=r"--xi is given together with study.toml; give only one of the two"):
        of_sections.sections(STUDY, xi="1,2")
    return status, ["found.h5"]


def _qtf(room):
    room.made = Made(SimpleNamespace(forces=0, held=SimpleNamespace(floats=True)))
    room.at(qtf__result__qtf=room.found, qtf__plot__draw=room.draw)
    room.patch.setattr("hakobune.bem.database.open_database", lambda path: "db")
    status = of_qtf.qtf(Path("body.h5"), omega="0.5:0.7:3", heading="0,90", difference=0.2, plot=PNG)
    of_qtf.qtf(Path("body.h5"), sums=True, highest=3.0)
    (given, one), (_, two) = room.asked
    assert given == ("db",) and one["omega"] == pytest.approx([0.5, 0.6, 0.7])
    assert one["headings"] == pytest.approx([0.0, math.pi / 2]) and two["headings"] is None and two["omega"] is None
    assert (one["highest"], one["sums"], two["highest"], two["sums"]) == (0.2, False, 3.0, True)
    for words, says in (({"difference": 0.2, "sums": True}, "--difference is given; it can be used without --sum"),
                        ({"highest": 3.0}, "--highest is given; it can be used with --sum")):  # fmt: skip
        with pytest.raises(ValueError, match=says):
            of_qtf.qtf(Path("body.h5"), **words)
    return status, ["plan.png"]


COMMANDS = (_waves, _passing, _damping, _members, _fender, _earthquake, _response, _breakwater, _moor, _single_point,
            _line, _lines, _line_dynamics, _sections, _qtf)  # fmt: skip


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.__name__.strip("_"))
def test_a_command_ends_with_the_status_of_its_result_and_names_its_files(command, room, capsys):
    status, named = command(room)
    assert status == STATUS
    assert [line for line in capsys.readouterr().out.splitlines() if line in named] == named
