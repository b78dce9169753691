"""README: every Python example runs as it is printed, and every command and flag that is shown exists."""

import io
import re
import sys
import warnings
from contextlib import redirect_stdout
from pathlib import Path

import pytest

from pipelines import cli

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```python\n(.*?)```", README, re.S)
# indented blocks, with continued lines joined; `hakobune …` in the text and in tables
SHELL = re.findall(r"^    (hakobune .*)$", README.replace("\\\n", " "), re.M)
COMMANDS = SHELL + re.findall(r"`(hakobune [a-z][^`]*)`", README)


FIRST_RUN = SHELL[1:4]  # the database of a box, its checks, its picture


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder after the first run of README"""
    place = tmp_path_factory.mktemp("readme")
    assert [line.split()[1] for line in FIRST_RUN] == ["box", "check", "plot"]
    for line in FIRST_RUN:
        with pytest.MonkeyPatch.context() as patch, redirect_stdout(io.StringIO()):
            patch.chdir(place)
            assert cli.main(line.split()[1:]) == 0, line
    assert (place / "box.h5").is_file() and (place / "box.png").is_file()
    return place


@pytest.mark.parametrize("text", EXAMPLES, ids=lambda text: text.strip().splitlines()[0].strip("# "))
def test_python_examples_run_as_printed(text, folder, monkeypatch):
    monkeypatch.chdir(folder)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exec(compile(text, "README.md", "exec"), {"__name__": "README"})


@pytest.mark.parametrize("command", sorted(set(COMMANDS)))
def test_commands_and_flags_shown_exist(command, capsys):
    name, *words = command.split()[1:]
    if name.startswith("-"):
        return
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", ["hakobune"])
        assert cli.main([name, "--help"]) == 0
    known = set(re.findall(r"--[a-z][a-z-]*", capsys.readouterr().out))
    flags = {word.split("=")[0] for word in words if re.match(r"--[a-z]", word)}
    assert flags <= known, flags - known
