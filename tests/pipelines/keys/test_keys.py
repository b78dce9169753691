"""The reference of keys is whole, and the files to begin with are those that are shipped."""

import ast
import json
import tomllib
from pathlib import Path

import msgspec
import pytest
from jsonschema import Draft202012Validator

from hakobune.pipelines import cli
from hakobune.pipelines.keys import shown
from hakobune.pipelines.keys.beginning import commented
from hakobune.pipelines.keys.kinds import KINDS, SCENES, _collect, struct_of
from hakobune.pipelines.keys.reference import Key, KeyTable, entries, reference, summary, tables_of
from hakobune.pipelines.keys.schema import schema
from hakobune.pipelines.keys.search import search
from hakobune.pipelines.keys.words import COMMON, ENDINGS

PIPELINES = Path(cli.__file__).parent
TABLES = list(dict.fromkeys(table for kind in KINDS for table in tables_of(kind)))


def names(table):
    return {field.encode_name for field in msgspec.structs.fields(table)}


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_has_a_text(kind):
    assert [(t.places, k.name) for t in reference(kind) for k in t.keys if not k.meaning and not k.unit] == []
    assert [t.places for t in reference(kind) if not t.meaning] == []


@pytest.mark.parametrize("ending, unit", [("_kN", "kN"), ("_kg_per_m", "kg/m"), ("_tonf", "tonf")])
def test_a_key_that_ends_with_a_unit_is_shown_in_it(ending, unit):
    found = {key.unit for kind in KINDS for t in reference(kind) for key in t.keys if key.name.endswith(ending)}
    assert found == {unit}


@pytest.mark.parametrize("table", TABLES, ids=lambda table: f"{table.__module__}.{table.__name__}")
def test_every_text_has_a_key(table):
    assert summary(table)
    known = names(table)
    stems = {name.removesuffix(ending) for name in known for ending in ENDINGS if name.endswith(ending)}
    assert set(entries(table)) <= known | stems


@pytest.mark.parametrize("words", [("polyester",), ("HMPE",), ("spiral",), ("catalogue",)])
def test_a_word_of_the_catalogue_of_lines_finds_all_its_names(words, capsys):
    assert cli.main(["keys", *words]) == 0
    said = capsys.readouterr().out
    assert "polyester|nylon|HMPE 160 mm" in said and "R3|R3S|R4|R4S|R5 studlink|studless 76 mm" in said
    assert cli.main(["keys", "draft"]) == 0
    assert "polyester" not in capsys.readouterr().out


def test_every_common_word_is_a_key_somewhere():
    assert set(COMMON) <= set().union(*map(names, TABLES))


def test_every_file_that_is_read_into_a_table_is_a_kind():
    read = set()
    for file in PIPELINES.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            called = isinstance(node, ast.Call) and getattr(node.func, "id", "") == "typed"
            if called and isinstance(node.args[1], ast.Name):  # a sweep reads its first case as a kind by name
                read.add((file.parent.name, node.args[1].id))
    known = {(struct.__module__.split(".")[-2], struct.__name__) for struct in map(struct_of, KINDS)}
    known.add(("solve", "Scene"))
    known.add(("site", "Linked"))  # a table of several kinds
    known.add(("fender", "FenderTable"))  # a table of studies, which the function takes alone
    assert read == known


@pytest.mark.parametrize(
    ("command", "file", "key", "readers"),
    [
        ("simulate", "single_point_barge.toml", "attachment", "hakobune single-point"),
        ("single-point", "simulate_chain_12.toml", "spreads", "hakobune moor or hakobune simulate"),
        ("solve", "single_point_A.toml", "hull", "hakobune single-point"),
        ("solve", "berth_tanker.toml", "depth", "hakobune berth"),
    ],
)
def test_a_file_of_another_command_names_that_command(command, file, key, readers, tmp_path, capsys):
    output = ["--output", str(tmp_path / "run.h5")]
    if command != "solve":
        output += ["--database", str(SCENES / file)]
    assert cli.main([command, str(SCENES / file), *output]) == 2
    said = f"hakobune {command}: {key} belongs to another command: this file is read by {readers}\n"
    assert capsys.readouterr().err == said
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_to_begin_with_says_what_its_example_says(kind):
    text, example = commented(kind), (SCENES / KINDS[kind].example).read_text(encoding="utf-8")
    assert tomllib.loads(text) == tomllib.loads(example)
    msgspec.convert(tomllib.loads(text), struct_of(kind))
    explained = [line for line in text.splitlines() if "#" in line]
    assert len(explained) > 5 and max(map(len, text.splitlines())) <= 160


@pytest.mark.parametrize("kind", ["system", "berth", "single-point"])
def test_a_file_to_begin_with_runs(kind, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["new", kind]) == 0
    step = capsys.readouterr().out.splitlines()[-1].split()
    assert step[0] == "hakobune" and cli.main(step[1:]) == 0


def test_a_ship_and_a_jetty_come_with_the_files_that_their_commands_read(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for kind in ("ship", "jetty"):
        assert cli.main(["new", kind]) == 0
    steps = [line.split() for line in capsys.readouterr().out.splitlines() if line.startswith("    ")]
    assert len(steps) == 4 and all(Path(step[2]).is_file() for step in steps)
    assert tomllib.loads(Path("ship.toml").read_text(encoding="utf-8"))["bodies"][0]["shape"] == "ship"
    project = tomllib.loads(Path("jetty.toml").read_text(encoding="utf-8"))
    assert {"rope", "fender"} <= set(tomllib.loads(Path(project["project"]["study"]).read_text(encoding="utf-8")))
    assert "PIANC" in {one["rule"] for one in project["rules"]}


def test_a_file_that_is_there_is_not_replaced(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["new", "study"]) == 0
    assert cli.main(["new", "response"]) == 0  # the scene that both need is the same
    (tmp_path / "series_box_20m.toml").write_text("changed")
    assert cli.main(["new", "simulation"]) == 2
    assert "series_box_20m.toml is there already and is not replaced" in capsys.readouterr().err
    assert not (tmp_path / "simulation.toml").exists()


def test_keys_are_found_by_command_table_and_name(capsys):
    assert cli.main(["keys", "moor", "pretension", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["name"] for row in rows} == {"pretension_tonf", "pretension_kN"}
    assert cli.main(["keys", "scene", "water"]) == 0
    assert "inf for deep water" in capsys.readouterr().out
    assert cli.main(["keys", "scene", "nothing"]) == 2
    assert cli.main(["keys", "pasta"]) == 2
    assert "allowed: scene, bodies, study" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "name", "table"),
    [
        (["Hs"], "height", "[waves]"),  # by the names of other programs
        (["Tp"], "peak_period", "[waves]"),
        (["MBL"], "breaking_load_kN", "[types.NAME]"),
        (["KG"], "center_of_gravity", "[[bodies]]"),
        (["pretension"], "pretension_kN", "[[spreads]]"),
        (["wave", "drift", "damping"], "wave_drift_damping", "[simulation]"),
        (["corrosion"], "corrosion_mm", "[types.NAME]"),
    ],
)
def test_a_search_of_all_files_shows_the_key_first(words, name, table):
    found = search(words)
    best = [one for one in found if one.key.name == name and table in one.places]
    assert best and found.index(best[0]) < 4, [one.key.name for one in found]


def test_a_search_is_printed_with_the_files_that_have_the_key_and_nothing_found_is_refused(capsys):
    assert cli.main(["keys", "mbl"]) == 0
    printed = capsys.readouterr().out
    assert "breaking_load_kN" in printed and "study, simulation" in printed
    assert cli.main(["keys", "pasta", "sauce"]) == 2
    assert "no key of any file contains 'pasta and sauce'" in capsys.readouterr().err


@pytest.fixture(scope="module")
def validators():
    """{kind: validator of its JSON Schema}; each schema is one of the draft that it names"""
    made = {kind: schema(kind) for kind in KINDS}
    for one in made.values():
        Draft202012Validator.check_schema(one)
    return {kind: Draft202012Validator(one) for kind, one in made.items()}


@pytest.mark.parametrize("file", sorted(SCENES.glob("*.toml")), ids=lambda file: file.name)
def test_schemas_accept_a_shipped_file_exactly_where_its_command_reads_it(file, validators):
    raw = tomllib.loads(file.read_text(encoding="utf-8"))
    read = {kind for kind in KINDS if reads(raw, kind)}
    assert read and {kind for kind, one in validators.items() if one.is_valid(raw)} == read


def reads(raw, kind):
    try:
        msgspec.convert(raw, struct_of(kind))
    except msgspec.ValidationError:
        return False
    return True


@pytest.mark.parametrize("kind", KINDS)
def test_a_schema_refuses_an_unknown_key_a_wrong_type_and_a_key_that_is_missing(kind, validators):
    raw = tomllib.loads((SCENES / KINDS[kind].example).read_text(encoding="utf-8"))
    first = next(iter(raw))
    assert validators[kind].is_valid(raw)
    assert not validators[kind].is_valid(raw | {"pasta": 1})
    assert not validators[kind].is_valid(raw | {first: {"pasta": 1} if isinstance(raw[first], list) else []})
    needed = validators[kind].schema["$defs"][struct_of(kind).__name__].get("required", [])
    assert all(not validators[kind].is_valid({k: v for k, v in raw.items() if k != key}) for key in needed)


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_of_a_schema_is_described_with_its_unit(kind, validators):
    properties = [p for one in validators[kind].schema["$defs"].values() for p in one["properties"].values()]
    assert properties and all(one["description"] for one in properties)
    told = [one["description"] for one in properties]
    assert all(any(text.startswith(key.unit) for text in told) for table in reference(kind) for key in table.keys)


def test_schemas_are_written_of_one_kind_or_of_all(tmp_path, capsys):
    assert cli.main(["keys", "moor", "--schema", str(tmp_path / "study.json")]) == 0
    assert json.loads((tmp_path / "study.json").read_text(encoding="utf-8"))["$ref"] == "#/$defs/Study"
    assert cli.main(["keys", "--schema", str(tmp_path / "all")]) == 0
    assert {path.name for path in (tmp_path / "all").iterdir()} == {f"{kind}.schema.json" for kind in KINDS}
    capsys.readouterr()
    for words, said in (
        (["study", "--schema", str(tmp_path / "study.toml")], "allowed: .json"),
        (["--schema", str(tmp_path / "study.json")], "give a folder"),
        (["study", "waves", "--schema", str(tmp_path / "waves.json")], "'waves' and --schema are given"),
    ):
        assert cli.main(["keys", *words]) == 2 and said in capsys.readouterr().err
    assert not (tmp_path / "waves.json").exists()


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_is_installed_with_all_commands_and_their_flags(shell, tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    place = tmp_path / "completion"
    assert cli.main(["--install-completion", "--shell", shell, "--output", str(place)]) == 0
    text = place.read_text(encoding="utf-8")
    assert all(name in text for name in cli.app if not name.startswith("-"))
    assert "database" in text and "rotation-center" in text


def test_entries_of_a_docstring_go_on_in_further_lines_and_end_at_a_paragraph():
    class Table:
        """A table

        a, b : m, of two; c : kN
        d : a text
            that goes on
        e : last
        Words : that are none of it stand here
        """

    assert entries(Table) == {
        "a": "m, of two", "b": "m, of two", "c": "kN", "d": "a text that goes on", "e": "last",
        "Words": "that are none of it stand here",
    }  # fmt: skip
    assert summary(Table) == "A table"


def test_values_of_keys_are_those_given_first_in_each_of_several_tables():
    """Two tables of one list, and two whose names the writer chose"""
    kind = {"mine": {"e": 5}, "his": {"f": 6}}
    raw = {"size": 2.0, "part": [{"a": 1, "b": {"c": 3}}, {"a": 9, "d": 4}], "kind": kind}
    values = {}
    _collect(raw, None, "", values)
    found = {path: value for path, value in values.items() if not isinstance(value, dict | list)}
    wanted = {".size": 2.0, "part.a": 1, "part.b.c": 3, "part.d": 4, "kind.NAME.e": 5, "kind.NAME.f": 6}
    assert wanted.items() <= found.items()


def key(name, unit="m", kind="number", needed=False, default=2.5, meaning="how deep", example=""):
    return Key("[water]", name, unit, kind, needed, default, meaning, example)


def test_the_reference_as_a_page_has_a_table_for_each_place_with_units_defaults_and_meanings():
    several = key("list", "s", "list of numbers", example="[1]")
    first = KeyTable(("",), "What comes first", (key("name", "", "text", True, None, "of the | study"),))
    tables = first, KeyTable(("[water]", "[sea]"), "Water of the place", (key("depth"), several))
    page = shown.as_markdown(tables).splitlines()
    assert page[0] == "### Before any table" and page[2] == "What comes first."
    assert page[6] == "| `name` |  | needed | of the \\| study |"
    assert page[8] == "### `[water]`, `[sea]`"
    assert page[14:] == ["| `depth` | m | 2.5 | how deep |",
                         "| `list` | s | 2.5 | how deep (list of numbers); e.g. [1] |"]  # fmt: skip


def test_the_reference_on_a_terminal_says_where_keys_stand_before_any_table():
    text = shown.as_text(
        (KeyTable(("",), "What comes first", (key("name"),)), KeyTable(("[sea]",), "Sea", (key("H"),)))
    )
    assert text.splitlines()[0] == "before any table  What comes first" and "[sea]  Sea" in text
    assert json.loads(shown.as_json((KeyTable(("[sea]",), "Sea", (key("H"),)),)))[0]["places"] == ["[sea]"]


@pytest.mark.parametrize(("words", "said"), [
    ("sea --Hs 3", "--Hs. It is --height here."), ("sea --height 2 --tp 9", "--tp. It is --peak-period here."),
    ("box --KG 3", "--KG. It is --center-of-gravity here."), ("box --Lpp 3", "Unknown option: --Lpp."),
    ("animate r.h5 --from 3 --output f.gif", "--from. It is --start here."),
    ("import a.1 --from wamit --GM 4", "--GM. It is --center-of-gravity here."),
    ("moor s.toml --database b.h5 --Hs 3", "Unknown option: --Hs."),  # the sea of moor is in its study, and no flag
])  # fmt: skip
def test_a_flag_by_its_name_in_other_programs_is_told_with_ours(words, said, capsys):
    assert cli.main(words.split()) == 2
    told = capsys.readouterr().err
    assert said in told and told.count("\n") == 1 and ("It is" in told) == ("It is" in said)


@pytest.mark.parametrize(("flag", "near"), [("lenght", "length"), ("heigth", "height"), ("time", ""), ("from_", "")])
def test_a_flag_is_compared_without_its_dashes_with_those_that_there_are(flag, near, capsys):
    """The two dashes of all flags made --time one like --step"""
    assert cli.main(["animate", "run.h5", f"--{flag}", "3", "--output", "f.gif"]) == 2
    said = f" Did you mean --{near}?" if near else ""
    assert capsys.readouterr().err == f"hakobune animate: Unknown option: --{flag}.{said}\n"
