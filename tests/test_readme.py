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

import hakobune
from hakobune.meshing.drawing import drawing_of
from hakobune.mooring.criteria.rules import read_rules, rule_names
from hakobune.pipelines import cli
from hakobune.pipelines.keys.kinds import KINDS, struct_of
from hakobune.pipelines.keys.search import search

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
    asked = [word for word in words if word[0] != "-"]
    if name == "new" and asked and asked[0] != "KIND":
        assert asked[0] in KINDS
    if name == "keys" and asked and asked[0] not in ("KIND", "WORD", "schemas"):
        assert asked[0] in KINDS or search(asked) or asked[0] in rule_names(read_rules())


@pytest.fixture(scope="module")
def generated():
    """{name: Markdown} of the pages that the guide makes from the code"""
    spec = importlib.util.spec_from_file_location("generated", ROOT / "docs" / "generated.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT / "docs"))
        return module.pages()


def heads(text):
    """Addresses of the headings of a page"""
    found = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M), re.M)
    return {re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", head).strip().lower()) for head in found}


def links(text):
    """(address, heading or empty) of the links of a page to others of the repository"""
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    return re.findall(r"\]\((?!https?:|mailto:)([^)#\s]*)#?([^)\s]*)\)", text)


def test_links_of_the_guide_lead_to_pages_and_headings_that_exist(generated):
    pages = {f"docs/{name}": text for name, text in generated.items()}
    pages |= {str(page): text for page, text in PAGES.items()}
    pages |= {name: (ROOT / name).read_text(encoding="utf-8") for name in ("CONTRIBUTING.md", "CHANGELOG.md")}
    assert len(generated) > len(KINDS) + 10
    for page, text in pages.items():
        for address, heading in links(text):
            target = (ROOT / page).parent.joinpath(address).resolve().relative_to(ROOT) if address else Path(page)
            assert str(target) in pages or (ROOT / target).exists(), f"{page}: {address}"
            if heading:
                assert heading in heads(pages[str(target)]), f"{page}: {address}#{heading}"


def test_the_guide_shows_every_page_and_no_other(generated):
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    shown = set(re.findall(r"^ +- ([\w/]+\.(?:md|ipynb))$", text, re.M))
    kept = {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.md")}
    kept |= {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.ipynb")}
    listed = {name for name in generated if not name.startswith(("keys-", "theory-"))}
    assert shown == kept | listed | {"CONTRIBUTING.md", "CHANGELOG.md"}
    for page in ("keys", "theory"):
        below = {name for name in generated if name.startswith(f"{page}-")}
        assert below == {address for address, _ in links(generated[f"{page}.md"]) if address.startswith(f"{page}-")}


@pytest.mark.parametrize("name", hakobune.__all__)
def test_every_public_name_is_in_the_reference_and_in_the_glossary_or_a_command(name, generated):
    assert re.search(rf"^::: hakobune\.[\w.]+\.{name}$", generated["api.md"], re.M)
    glossary = PAGES[Path("docs/glossary.md")]
    assert f"`{name}`" in glossary or f"`{name.replace('_', '-')}`" in glossary
