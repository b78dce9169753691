"""Kernels that a second process compiles while a command begins: when it begins, and that they are those needed."""

from types import SimpleNamespace

import numba
import pytest

from hakobune.bem.kernels import jit
from hakobune.mooring.lines.dynamics.lumped import esdirk, settle
from hakobune.pipelines import compiling
from hakobune.pipelines.executors import beside
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.line_dynamics.parts import line_of
from hakobune.pipelines.line_dynamics.result import line_dynamics
from hakobune.pipelines.line_dynamics.study import read_line_dynamics

SOURCE = "mooring/motion/integrator.py"


@pytest.fixture
def begun(monkeypatch, tmp_path):
    """Commands of processes that `begin_beside` begins, with an empty folder of kernels and two processors"""
    found = []

    def popen(command, **more):
        found.append(command[1:])
        return SimpleNamespace(kill=lambda: found.append("killed"))

    monkeypatch.setenv("HAKOBUNE_CACHE", str(tmp_path / "kernels"))
    monkeypatch.setattr(beside.subprocess, "Popen", popen)
    monkeypatch.setattr(beside, "processors", lambda: 2)
    monkeypatch.setattr(beside.atexit, "register", lambda call: call())
    monkeypatch.setattr(beside, "_begun", [])
    jit._sources.cache_clear()
    return found


def test_a_second_process_begins_where_kernels_lack_and_ends_with_the_command(begun):
    beside.begin_beside("simulate", SOURCE, "a.toml", "box.h5")
    assert begun == [["-m", "hakobune.pipelines.compiling", "simulate", "a.toml", "box.h5"], "killed"]
    beside.begin_beside("simulate", SOURCE, "b.toml", "box.h5")
    assert len(begun) == 2  # one is enough
    beside._begun.clear()
    jit.cache_folder(jit.ROOT / SOURCE, jit.ROOT).mkdir(parents=True)
    beside.begin_beside("simulate", SOURCE, "a.toml", "box.h5")
    assert len(begun) == 2


def test_no_second_process_begins_on_one_processor_or_where_nothing_can_be_kept(begun, monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    with monkeypatch.context() as changed:
        changed.setattr(beside, "processors", lambda: 1)
        beside.begin_beside("line-dynamics", SOURCE, "a.toml")
    monkeypatch.setenv("HAKOBUNE_CACHE", str(tmp_path / "file" / "kernels"))
    jit._sources.cache_clear()
    beside.begin_beside("line-dynamics", SOURCE, "a.toml")
    assert not begun


def test_steps_compiled_beside_are_those_that_the_command_takes(monkeypatch):
    """Types of arguments of the kernel of all steps; the shape at rest, which the command finds meanwhile, is left"""
    kinds = []

    def follow(*arguments):
        kinds.append(tuple(map(numba.typeof, arguments)))
        return steps(*arguments)

    steps = esdirk.follow
    monkeypatch.setattr(esdirk, "follow", follow)
    line_dynamics(SCENES / "line_chain_60m.toml", duration=18.0)
    asked = set(kinds)
    assert asked
    kinds.clear()
    monkeypatch.setattr(settle, "settle", None)
    with pytest.warns(UserWarning):  # of a line that is far from its shape at rest
        compiling.OF_COMMANDS["line-dynamics"](SCENES / "line_chain_60m.toml")
    assert set(kinds) == asked


def test_kernels_compiled_before_the_steps_are_the_versions_that_steps_call():
    """Each has one version after lines in motion, and it is there before"""
    first = esdirk.factor_line, esdirk.correction, esdirk.error, esdirk.record, esdirk.keep_slip, esdirk.predict
    esdirk.compile_steps(line_of(read_line_dynamics(SCENES / "line_chain_60m.toml")[0])[0].system)
    before = [tuple(kernel.called.overloads) for kernel in first]
    line_dynamics(SCENES / "line_chain_60m.toml", duration=18.0)
    assert all(before)
    assert [tuple(kernel.called.overloads) for kernel in first] == before


def test_every_command_of_the_table_is_begun_by_its_command():
    begins = {"simulate": "simulate/flags.py", "line-dynamics": "line_dynamics/command.py"}
    room = compiling.SCENES.parent
    assert begins.keys() == compiling.OF_COMMANDS.keys()
    for command, file in begins.items():
        assert f'begin_beside("{command}", "mooring/' in (room / file).read_text()
