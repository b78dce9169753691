"""What is shown of keys, word by word, of tables made for it; types, units and examples of keys of a table of every
kind of hint; the example of a file with its comments, of a reference that is set by hand."""

import json
import shutil
from types import SimpleNamespace

import msgspec
import pytest

from hakobune.pipelines.keys import beginning, reference, search, shown
from hakobune.pipelines.keys.kinds import KINDS
from hakobune.pipelines.keys.reference import Key, KeyTable
from hakobune.pipelines.keys.search import Found


def key(name, unit="m", kind="number", needed=False, default=2.5, meaning="how deep", example=""):
    return Key("[water]", name, unit, kind, needed, default, meaning, example)


DEPTH, WIDE = key("depth"), key("wide", "", "text", True, None, "", '"yes"')
LIST = key("times", "s", "list of numbers", default=[1, 2], meaning="when it is", example="[3]")
WATER, SEA = KeyTable(("[water]", "[sea.place]"), "Of the water", (DEPTH, WIDE)), KeyTable(("",), "All", (LIST,))


def test_kinds_are_listed_with_their_commands_in_three_forms(monkeypatch):
    two = {
        "study": SimpleNamespace(meaning="a mooring", commands="moor"),
        "seas": SimpleNamespace(meaning="waves", commands="sea, site"),
    }
    monkeypatch.setattr(shown, "KINDS", two)
    text = shown.kinds_text(False, False).splitlines()
    assert text[:3] == ["study          a mooring; read by moor", "seas           waves; read by sea, site", ""]
    assert "\n".join(text[3:]) == shown.STEPS
    page = [
        "| kind | what it is | commands |",
        "|---|---|---|",
        "| study | a mooring | moor |",
        "| seas | waves | sea, site |",
    ]
    assert shown.kinds_text(False, True).splitlines() == page
    data = {
        "study": {"meaning": "a mooring", "commands": "moor"},
        "seas": {"meaning": "waves", "commands": "sea, site"},
    }
    assert json.loads(shown.kinds_text(True, False)) == data


@pytest.mark.parametrize(
    ("word", "names"),
    [
        ("[water]", [["depth", "wide"]]),
        ("place", [["depth", "wide"]]),
        ("WATER", [["depth", "wide"]]),
        ("dep", [["depth"]]),
        ("E", [["depth", "wide"], ["times"]]),
        ("when", [["times"]]),
        ("how", [["depth"]]),
        ("nothing", []),
        ("wat", []),
    ],
)
def test_tables_with_a_word_in_heading_or_name_come_before_meanings(word, names):
    """A heading has whole words; a name or a meaning parts"""
    own = [[k.name for k in table.keys] for table in shown.having((WATER, SEA), word)]
    assert own == names


def test_found_keys_of_the_same_places_and_files_share_a_table():
    of = [
        Found(DEPTH, ("[a]",), ("study",)),
        Found(LIST, ("[b]",), ("study", "seas")),
        Found(WIDE, ("[a]",), ("study",)),
    ]
    first, second = shown.tables_found(of)
    assert first == KeyTable(("[a]",), "of study", (DEPTH, WIDE))
    assert second == KeyTable(("[b]",), "of study, seas", (LIST,))


@pytest.mark.parametrize(("one", "default", "text"), [
    (DEPTH, "2.5", "how deep"),
    (key("d", example="2.5"), "2.5", "how deep"), (key("d", example="3"), "2.5", "how deep; e.g. 3"),
    (WIDE, "needed", 'wide; e.g. "yes"'), (LIST, "[1, 2]", "when it is (list of numbers); e.g. [3]"),
    (key("two_words", default=None, meaning="", kind="table"), "", "two words"),
    (key("t", kind="tables"), "2.5", "how deep"), (key("t", kind="table by name"), "2.5", "how deep"),
    (key("t", kind="text"), "2.5", "how deep"), (key("t", kind="whole number"), "2.5", "how deep (whole number)"),
])  # fmt: skip
def test_a_key_is_explained_by_meaning_type_and_example(one, default, text):
    assert shown.default_of(one) == default and shown.explained(one) == text


def test_the_reference_on_a_terminal_is_in_columns_of_the_longest_name_and_unit(monkeypatch):
    monkeypatch.setattr(shutil, "get_terminal_size", lambda _: SimpleNamespace(columns=62))
    long = key("list", "kN/m", meaning="a meaning that does not fit into one line of this narrow terminal, by far")
    wide = KeyTable(("[water]", "[sea]"), "a heading that does not fit into one line of this narrow one", (DEPTH, long))
    assert shown.as_text((SEA, wide)).splitlines() == [
        "before any table  All",
        "  times  s     when it is (list of numbers); e.g. [3] [[1, 2]]",
        "",
        "[water], [sea]  a heading that does not fit into one line of",
        "  this narrow one",
        "  depth  m     how deep [2.5]",
        "  list   kN/m  a meaning that does not fit into one line of",
        "               this narrow terminal, by far [2.5]",
    ]
    monkeypatch.setattr(shutil, "get_terminal_size", lambda _: SimpleNamespace(columns=20))
    assert max(map(len, shown.as_text((SEA, wide)).splitlines())) <= 60  # no narrower than sixty
    monkeypatch.setattr(shutil, "get_terminal_size", lambda _: SimpleNamespace(columns=70))
    far = KeyTable(("",), "All", (key("a" * 50, meaning="that goes on into another line"),))
    assert [len(line) - len(line.lstrip()) for line in shown.as_text((far,)).splitlines()] == [0, 2, 40]


def test_the_reference_as_data_has_every_field_and_the_places():
    rows = json.loads(shown.as_json((WATER, SEA)))
    assert [row["name"] for row in rows] == ["depth", "wide", "times"]
    assert rows[0] == {
        "table": "[water]",
        "name": "depth",
        "unit": "m",
        "type": "number",
        "needed": False,
        "default": 2.5,
        "meaning": "how deep",
        "example": "",
        "places": ["[water]", "[sea.place]"],
    }
    assert "\n" in shown.as_json((WATER,)) and "°" in shown.as_json((KeyTable(("",), "", (key("a", "°"),)),))


class Inner(msgspec.Struct):
    """An inner table

    a : m, depth of it
    """

    a: float


class Every(msgspec.Struct):
    """Every hint

    one_kN, whole : pull
    text : rad/s
    """

    one_kN: float
    whole: int | None = None
    text: str | float = "x"
    flag: bool = True
    numbers: list[float] = msgspec.field(default_factory=lambda: [1.0, 2.5])
    rows: list[list[float]] = []
    pair: tuple[float, float] = (0.0, 1.0)
    words: tuple[str, str, str] | None = None
    table: dict[str, float] = msgspec.field(default_factory=dict)
    inner: Inner | None = None
    several: list[Inner] = []
    named: dict[str, Inner] = {}


def test_types_units_defaults_and_examples_of_every_hint():
    found = {}
    reference._walk(Every, "", "", found)
    assert found == {
        Every: [("", "")],
        Inner: [("[inner]", "inner"), ("[[several]]", "several"), ("[named.NAME]", "named.NAME")],
    }
    keys = {
        k.name: k for k in reference._keys(Every, found[Every], {".whole": 7, ".inner": {"a": 1}, "other.flag": False})
    }
    assert {name: k.type for name, k in keys.items()} == {
        "one_kN": "number", "whole": "whole number", "text": "text or number", "flag": "true or false",
        "numbers": "list of numbers", "rows": "list of lists of numbers", "pair": "2 numbers", "words": "3 texts",
        "table": "table of numbers", "inner": "table", "several": "tables", "named": "table by name",
    }  # fmt: skip
    assert keys["one_kN"][2:8] == ("kN", "number", True, None, "pull", "")
    assert (keys["whole"].example, keys["inner"].example, keys["flag"].example) == ("7", "", "")
    assert [keys[name].default for name in ("whole", "text", "flag", "numbers", "pair")] == [
        None,
        "x",
        True,
        [1.0, 2.5],
        (0.0, 1.0),
    ]
    assert keys["table"].default is None and not keys["table"].needed
    assert (keys["text"].unit, keys["text"].meaning) == ("rad/s", "")
    assert keys["inner"].meaning == keys["several"].meaning == "An inner table" and keys["inner"].table == ""
    (a,) = reference._keys(Inner, found[Inner], {"several.a": 3.5})
    assert a == Key("[inner]", "a", "m", "number", True, None, "depth of it", "3.5")


@pytest.mark.parametrize(("value", "text"), [
    (True, "true"), (False, "false"), (3, "3"), (2.5, "2.5"), ("a", '"a"'), ([1, "b"], '[1, "b"]'),
    ((1, True), "[1, true]"), ({}, "{}"), ({"a": 1, "b": [2]}, "{ a = 1, b = [2] }"), ([], "[]"),
])  # fmt: skip
def test_values_are_shown_as_toml_writes_them(value, text):
    assert reference.toml(value) == text


def test_the_unit_of_a_path_is_that_of_its_table():
    assert reference.unit_of("single-point", "hawser.length") == "m"
    assert reference.unit_of("single-point", "hawser.nothing") == reference.unit_of("single-point", "length") == ""
    assert reference.unit_of("single-point", "waves.direction_deg") == "°"


def test_a_search_ranks_name_before_part_heading_and_meaning(monkeypatch):
    one = key("deep", meaning="of the pool")
    assert [search._rank([word], one, ("[Water]",)) for word in ("deep", "dee", "wat", "pool", "x")] == [
        0,
        1,
        2,
        3,
        None,
    ]
    assert search._rank(["dee", "pool"], one, ()) == 4 and search._rank(["deep", "x"], one, ()) is None
    monkeypatch.setattr(search, "OTHER_NAMES", {"deep": "kg tp"})
    assert search._rank(["tp"], one, ()) == 0
    tables = {
        "study": (KeyTable(("[a]",), "", (key("deepest"), key("width", meaning="deep")))),
        "seas": (KeyTable(("[b]",), "", (key("deep"), key("deepest")))),
    }
    monkeypatch.setattr(search, "KINDS", tables)
    monkeypatch.setattr(search, "reference", lambda kind: (tables[kind],))
    found = search.search(["[Deep]"])
    assert [(one.key.name, one.places, one.kinds) for one in found] == [
        ("deep", ("[b]",), ("seas",)), ("deepest", ("[a]", "[b]"), ("study", "seas")), ("width", ("[a]",), ("study",))
    ]  # fmt: skip


EXAMPLE = """\
# A pool
deep = 2.0
long = [1.0,
 2.0]
wide = 3.0 # told already
deep = 4.0

[[walls.north]]
deep = 5.0
odd = 1
[other]
deep = 6.0
"""


def test_keys_of_an_example_are_explained_once_where_they_come_first(monkeypatch, tmp_path):
    """Beside the key, above it where it does not fit or goes on, not where something is told already"""
    (tmp_path / "pool.toml").write_text(EXAMPLE)
    keys = (key("deep"), key("long", "m²", meaning="a list"), key("wide"), key("odd", ""))
    tables = (
        KeyTable(("",), "", keys),
        KeyTable(("[walls.NAME]", "[other]"), "", (key("deep", "ft", meaning="x" * 200), keys[3])),
    )
    monkeypatch.setattr(beginning, "SCENES", tmp_path)
    kind = SimpleNamespace(example="pool.toml")
    monkeypatch.setattr(beginning, "KINDS", {"other": SimpleNamespace(example="b.toml"), "pool": kind})
    monkeypatch.setattr(beginning, "kind_named", lambda name: kind)
    monkeypatch.setattr(beginning, "reference", lambda name: tables)
    lines = beginning.commented("swim").splitlines()
    assert lines == [
        "# hakobune keys pool   explains every key, including those that are not in this file", "# A pool",
        "deep = 2.0  # m, how deep", "# long: m², a list", "long = [1.0,", " 2.0]", "wide = 3.0 # told already",
        "deep = 4.0", "", "[[walls.north]]", f"# deep: ft, {'x' * 200}", "deep = 5.0", "odd = 1  # how deep", "[other]",
        f"# deep: ft, {'x' * 200}", "deep = 6.0",
    ]  # fmt: skip
    assert beginning.commented("swim").endswith("deep = 6.0\n")


@pytest.mark.parametrize(("length", "beside"), [(94, True), (95, False)])
def test_a_comment_goes_above_a_line_that_it_would_make_longer_than_110(monkeypatch, tmp_path, length, beside):
    """`deep = 2.0` and two spaces, a sign and another space are 14"""
    (tmp_path / "pool.toml").write_text("deep = 2.0\n")
    remark = "y" * (length + 2)
    kind = SimpleNamespace(example="pool.toml")
    monkeypatch.setattr(beginning, "SCENES", tmp_path)
    monkeypatch.setattr(beginning, "KINDS", {"pool": kind})
    monkeypatch.setattr(beginning, "kind_named", lambda name: kind)
    monkeypatch.setattr(beginning, "reference", lambda name: (KeyTable(("",), "", (key("deep", "", meaning=remark),)),))
    lines = beginning.commented("pool").splitlines()[1:]
    assert lines == ([f"deep = 2.0  # {remark}"] if beside else [f"# deep: {remark}", "deep = 2.0"])


def test_files_that_an_example_names_are_found_through_others(monkeypatch, tmp_path):
    (tmp_path / "a.toml").write_text('x = ["b.toml", {y = "c.csv"}, "none.toml", "sub/d.csv", 3]\n')
    (tmp_path / "b.toml").write_text('again = "a.toml"\nz = "e.csv"\n')
    for name in ("c.csv", "e.csv", "f.csv"):
        (tmp_path / name).write_text("1\n")
    monkeypatch.setattr(beginning, "SCENES", tmp_path)
    found = beginning.needed(tmp_path / "a.toml", ("f.csv",))
    assert sorted(path.name for path in found) == ["b.toml", "c.csv", "e.csv", "f.csv"] and len(found) == 4


def test_a_file_to_begin_with_comes_with_what_it_needs_and_its_steps(monkeypatch, tmp_path):
    home, out = tmp_path / "scenes", tmp_path / "out"
    home.mkdir(), out.mkdir()
    (home / "pool.toml").write_text('other = "b.csv"\n')
    (home / "b.csv").write_text("1\n")
    kind = SimpleNamespace(example="pool.toml", beside=(), steps=("solve FILE", "moor FILE series_box.toml"))
    monkeypatch.setattr(beginning, "SCENES", home)
    monkeypatch.setattr(beginning, "kind_named", lambda name: kind)
    monkeypatch.setattr(beginning, "commented", lambda name: f"# solve pool.toml, of {name}")
    files, steps = beginning.write("pool", out / "mine.toml")
    assert files == [out / "mine.toml", out / "b.csv"]
    assert [file.read_text() for file in files] == ["# solve mine.toml, of pool", "1\n"]
    assert steps == [f"solve {out}/mine.toml", f"moor {out}/mine.toml {out}/series_box.toml"]
    with pytest.raises(ValueError, match=r"mine\.toml is there already and is not replaced; give another name or"):
        beginning.write("pool", out / "mine.toml")
    with pytest.raises(ValueError, match=r"mine\.txt has the suffix '\.txt'; allowed: \.toml"):
        beginning.write("pool", out / "mine.txt")
    monkeypatch.chdir(out)
    _, steps = beginning.write("pool", "two.toml")  # b.csv is the same, and stays
    assert steps == ["solve two.toml", "moor two.toml series_box.toml"]
    (out / "b.csv").write_text("2\n")
    with pytest.raises(ValueError, match=r"^b\.csv is there already"):
        beginning.write("pool", "three.toml")
    assert not (out / "three.toml").exists() and (out / "b.csv").read_text() == "2\n"


def test_every_kind_has_its_example():
    assert all((beginning.SCENES / kind.example).is_file() for kind in KINDS.values())
