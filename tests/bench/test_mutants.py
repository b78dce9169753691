"""Faults that the campaign puts in, and the tests it takes first."""

import ast
import fnmatch
import sqlite3
import tomllib

from bench.covered import Covered
from bench.mutants import changed, drawn, faults
from near import PACKAGES, ROOT, distances, nearest

SOURCE = '''
def area(x, y, n):
    """a * b"""
    if n < 1:
        return 0.0
    total = 0.0
    for i in range(n):
        total += x[0] * y[i] ** 2 - 0.5
    print(f"{2 * total:.1f} – m²", max(x, y))
    return -total
'''


def operators():
    return {(operator, before, after) for operator, _, before, after in _told()}


def _told():
    for operator, line, first, last, after, _ in faults(SOURCE):
        yield operator, line, SOURCE.encode()[first:last].decode(), after


def test_each_kind_of_fault_is_found_where_it_stands():
    found = operators()
    assert ("comparison", "n < 1", "(n > 1)") in found
    assert ("early return dropped", "return 0.0", "pass") in found
    assert ("index", "x[0]", "(x[1])") in found
    assert ("index", "y[i]", "(y[i - 1])") in found
    assert ("power", "y[i] ** 2", "(y[i] ** 3)") in found
    assert ("term dropped", "x[0] * y[i] ** 2 - 0.5", "(0.5)") in found
    assert ("sign", "-total", "(total)") in found
    assert not any(name == "names swapped" for name, *_ in found)
    assert any(name == "early end" and after.endswith("\n        break") for name, _, after in found)
    assert any(name == "factor 2" and "2 * (2 * total)" in after for name, _, after in found)


def test_a_fault_changes_the_code_and_leaves_it_one_that_python_reads():
    sound = ast.dump(ast.parse(SOURCE))
    for _, _, first, last, after, _ in faults(SOURCE):
        assert ast.dump(ast.parse(changed(SOURCE, first, last, after))) != sound


def test_the_draw_follows_from_its_seed_and_leaves_out_what_is_known_as_equivalent():
    first = drawn(7, 12, "meshing", ROOT, {})
    assert first != drawn(8, 12, "meshing", ROOT, {})
    plain, own, kept = first[:3]
    known = [
        {"file": row["file"], "before": row["before"], "after": row["after"].strip("()")} | more
        for row, more in ((plain, {}), (own, {"function": own["function"]}), (kept, {"function": "of another"}))
    ]
    assert drawn(7, 10, "meshing", ROOT, {"mutant": known}) == first[2:]
    left = drawn(7, 12, "meshing", ROOT, {"files": {plain["file"]: "a reason"}})
    assert len(left) == 12 and not [row for row in left if row["file"] == plain["file"]]


def test_all_that_is_left_out_is_there_and_has_a_reason():
    known = tomllib.loads((ROOT / "tests" / "bench" / "mutants_equivalent.toml").read_text(encoding="utf-8"))
    files = [str(file.relative_to(ROOT)) for package in PACKAGES for file in (ROOT / package).rglob("*.py")]
    for pattern, reason in known["files"].items():
        assert reason and fnmatch.filter(files, pattern), pattern
    for row in known.get("mutant", ()):
        assert row["reason"]
        assert row["before"] in (ROOT / row["file"]).read_text(encoding="utf-8"), row


def test_the_nearest_test_is_the_changed_one_and_then_the_one_that_imports_and_mirrors():
    gusts = ROOT / "mooring" / "environment" / "gusts.py"
    own, other = ROOT / "tests" / "mooring" / "environment" / "test_gusts.py", ROOT / "tests" / "test_layers.py"
    assert nearest([gusts])[0] == own
    assert nearest([gusts, other])[:2] == [other, own]
    assert distances([gusts])[own] == 1


def test_a_module_that_a_test_names_in_parts_is_as_near_as_one_that_it_imports(tmp_path):
    """plain(f"bem.{name}") of names in a list, plain("mooring.a"), and neither of what is only alike"""
    (tmp_path / "tests").mkdir()
    for file in ("bem/panels/one.py", "bem/panels/two.py", "bem/other.py", "mooring/a.py"):
        (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / file).write_text("")
    text = 'one, none = (plain(f"bem.{name}") for name in ("panels.one", "none"))\na, b = plain("mooring.a"), "two"\n'
    (tmp_path / "tests" / "test_it.py").write_text(text)
    test = tmp_path / "tests" / "test_it.py"
    for file, near in (
        ("bem/panels/one.py", True),
        ("mooring/a.py", True),
        ("bem/panels/two.py", False),
        ("bem/other.py", False),
    ):
        assert (distances([tmp_path / file], tmp_path).get(test) == 1) is near, file


def test_what_commands_import_is_reached_by_the_tests_of_commands():
    reached = nearest([ROOT / "mooring" / "fenders" / "curves.py"])
    assert ROOT / "tests" / "pipelines" / "fender" / "test_fender_command.py" in reached


def test_a_line_is_judged_by_the_tests_that_execute_it_and_a_constant_by_those_of_the_lines_that_mention_it(tmp_path):
    (tmp_path / "mooring").mkdir()
    (tmp_path / "tests" / "mooring").mkdir(parents=True)
    source = "K = 2.0\n\n\ndef double(x):\n    return K * x\n\n\ndef other():\n    return 1\n"
    (tmp_path / "mooring" / "a.py").write_text(source)
    (tmp_path / "tests" / "mooring" / "test_a.py").write_text("def test_1():\n    pass\n\n\ndef test_2():\n    pass\n")
    data = sqlite3.connect(tmp_path / "map")
    data.executescript("create table file (id, path); create table context (id, context);")
    data.execute("create table line_bits (file_id, context_id, numbits)")
    data.execute("insert into file values (1, '/elsewhere/mooring/a.py')")
    data.execute("insert into context values (1, 'tests/mooring/test_a.py::test_1|run')")
    data.execute("insert into context values (2, 'tests/mooring/test_a.py::test_2|setup')")
    data.execute("insert into line_bits values (1, 1, ?), (1, 2, ?)", (bytes([1 << 5]), bytes([1 << 1, 1 << 1])))
    data.commit()
    case = '<testcase classname="tests.mooring.test_a" name="test_{}" time="{}"/>'
    (tmp_path / "times").write_text(f"<s>{case.format(1, 3.0)}{case.format(2, 0.1)}</s>")
    covered = Covered(tmp_path / "map", tmp_path / "times", tmp_path)
    first, second = "tests/mooring/test_a.py::test_1", "tests/mooring/test_a.py::test_2"
    assert covered.tests("mooring/a.py", 5) == {first} == covered.tests("mooring/a.py", 1)
    assert covered.tests("mooring/a.py", 9) == {second}
    assert covered.chosen("mooring/a.py", 5, "double", 10.0) == [first, second]
    assert covered.chosen("mooring/a.py", 5, "double", 3.05) == [first]
