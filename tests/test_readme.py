"""README and the guide: Python runs as printed, commands and flags exist, TOML is read, links lead somewhere."""

import importlib.util
import io
import re
import sys
import tomllib
import warnings
from contextlib import redirect_stdout
from pathlib import Path

import msgspec
import pytest

from hakobune.meshing.drawing import drawing_of
from hakobune.pipelines import cli
from hakobune.pipelines.keys.kinds import KINDS, struct_of

ROOT = Path(__file__).parents[1]
PAGES = {path.relative_to(ROOT): path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md")}
PAGES[Path("README.md")] = (ROOT / "README.md").read_text(encoding="utf-8")
EXAMPLES = [
    (str(page), text) for page, whole in PAGES.items() for text in re.findall(r"```python\n(.*?)```", whole, re.S)
]
TABLES = [(str(page), text) for page, whole in PAGES.items() for text in re.findall(r"```toml\n(.*?)```", whole, re.S)]


def shell(text):
    """Indented commands of a page, continued lines joined"""
    return re.findall(r"^    (hakobune .*)$", text.replace("\\\n", " "), re.M)


COMMANDS = {line for text in PAGES.values() for line in shell(text) + re.findall(r"`(hakobune [a-z][^`]*)`", text)}
FIRST_RUN = shell(PAGES[Path("docs/first_hour.md")])[:3]  # the database of a box, its checks, its picture


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder after the first run of the guide"""
    place = tmp_path_factory.mktemp("readme")
    assert [line.split()[1] for line in FIRST_RUN] == ["box", "check", "plot"]
    for line in FIRST_RUN:
        with pytest.MonkeyPatch.context() as patch, redirect_stdout(io.StringIO()):
            patch.chdir(place)
            assert cli.main(line.split()[1:]) == 0, line
    assert (place / "box.h5").is_file() and (place / "box.png").is_file()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(io.StringIO()):
        patch.chdir(place)
        assert cli.main(["new", "study"]) == 0
    return place


@pytest.mark.parametrize("page, text", EXAMPLES, ids=lambda text: text.strip().splitlines()[0].strip("# "))
def test_python_examples_run_as_printed(page, text, folder, monkeypatch):
    monkeypatch.chdir(folder)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exec(compile(text, page, "exec"), {"__name__": "README"})


OF_DOWNTIME = {"hindcast": {"file": "hindcast.csv", "x_axis_compass_deg": 0.0}, "operations": []}
# what a file needs beside a part of it that a page shows
PARTS = {
    ("docs/berth.md", "simulation"): {"water": {"depth": 20.0}},
    ("docs/several_bodies.md", "method"): {"water": {"depth": 9.0}, "bodies": [], "waves": {}},
    ("docs/several_bodies.md", "modes"): {"water": {"depth": 9.0}, "bodies": [], "waves": {}},
    ("docs/several_bodies.md", "damping_lids"): {"water": {"depth": 9.0}, "bodies": [], "waves": {}},
    ("docs/several_bodies.md", "hulls"): {"water": {"depth": 9.0}},
    ("docs/several_bodies.md", "lines_file"): {"water": {"depth": 50.0}},
    ("docs/downtime.md", "simulation"): OF_DOWNTIME,
    ("docs/downtime.md", "lee"): OF_DOWNTIME,
    ("docs/downtime.md", "passages"): OF_DOWNTIME,
}


@pytest.mark.parametrize("page, text", TABLES, ids=lambda text: text.strip().splitlines()[0])
def test_tables_shown_are_read(page, text):
    raw, faults = PARTS.get((page, next(iter(tomllib.loads(text)))), {}) | tomllib.loads(text), []
    if "parts" in raw:  # a hull that is drawn
        assert drawing_of(raw).parts
        return
    for kind in KINDS:
        try:
            msgspec.convert(raw, struct_of(kind))
            return
        except msgspec.ValidationError as fault:
            faults.append(str(fault))
    raise AssertionError(faults)


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_commands_and_flags_shown_exist(command, capsys):
    name, *words = command.split()[1:]
    if name.startswith("-"):
        return
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", ["hakobune"])
        assert cli.main([name, "--help"]) == 0
    known = {*re.findall(r"--[a-z][a-z-]*", capsys.readouterr().out), "--csv", "--json"}
    flags = {word.split("=")[0] for word in words if re.match(r"--[a-z]", word)}
    assert flags <= known, flags - known
    if name in ("keys", "new") and words and words[0] not in ("KIND",):
        assert words[0] in KINDS


def test_links_of_the_guide_lead_somewhere(tmp_path):
    spec = importlib.util.spec_from_file_location("build", ROOT / "docs" / "build.py")
    build = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(build)
    written = {path.name: path.read_text(encoding="utf-8") for path in build.build(tmp_path)}
    assert len(written) > len(KINDS) + 10
    for name, text in written.items():
        for target in re.findall(r'(?:href|src)="([^"#:]+)"', text):
            assert (tmp_path / target).exists() or (ROOT / "docs" / target).exists(), f"{name}: {target}"
    reached = {
        link
        for page in ("index.html", "keys.html", "tasks.html")
        for link in re.findall(r'href="([^"#]+)"', written[page])
    }
    assert set(written) <= reached | {"index.html"}
