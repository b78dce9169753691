"""Which tests execute a line, by a map of the whole suite that coverage.py made, and how long each takes.

The map is made in an environment of its own, since nothing else needs the library, at the commit that is judged:

    pip install --target build/coverage pytest-cov
    PYTHONPATH=build/coverage python -m pytest --from-both-ends -n 2 --junitxml=times.xml \
        --cov=. --cov-context=test --cov-report=

which leaves `.coverage`, a database of SQLite with a row for each file and test: bit n of its bytes is line n.  What is
inside a compiled kernel is not seen, nor are constants of a module: for these the lines that mention them count, and
the lines that mention what those are in, up to one that some test executes.
"""

import ast
import re
import sqlite3
import xml.etree.ElementTree as xml
from collections import defaultdict
from functools import cache
from itertools import accumulate
from pathlib import Path

from near import PACKAGES, importers

PHASE = re.compile(r"\|(setup|run|teardown)$")
FILES = 12  # of tests, all of which are collected before any runs
OTHERS = 0.4  # share of the time that is kept for tests of other folders


class Covered:
    """Tests by line.  map, times : files, see above; root : the checkout that is judged"""

    def __init__(self, map, times, root):
        self.root, self.data = root, sqlite3.connect(map)
        cases = xml.parse(times).iter("testcase")
        self.seconds = {_node(case.get("classname"), case.get("name")): float(case.get("time")) for case in cases}
        self.of_file = cache(self._of_file)

    def _of_file(self, name):
        """{line: tests} of a source file, by its path below the root"""
        rows = self.data.execute(
            "select context.context, line_bits.numbits from line_bits join context on context.id = context_id"
            " join file on file.id = file_id where file.path like ?",
            (f"%/{name}",),
        )
        found = defaultdict(set)
        for test, bits in rows:
            for line in (8 * i + bit for i, byte in enumerate(bits) for bit in range(8) if byte >> bit & 1):
                found[line].add(PHASE.sub("", test))
        return found

    def direct(self, name, line):
        """Tests that execute a line of Python in a function"""
        lines, _, inside = _statement(_tree(self.root / name), line)
        return (inside and set().union(*(self.of_file(name).get(i, ()) for i in lines)) & self.seconds.keys()) or set()

    def tests(self, name, line, seen=None):
        """Tests that execute the statement at a line, or else what mentions what it is part of"""
        seen = set() if seen is None else seen
        if found := self.direct(name, line):
            return found
        _, symbols, _ = _statement(_tree(self.root / name), line)
        for file in (self.root / name, *importers(self.root).get(self.root / name, ())):
            where = str(file.relative_to(self.root))
            if where.split("/")[0] in PACKAGES:
                for at in (at for symbol in symbols for at in _mentions(_tree(file), symbol)):
                    if (where, at) not in seen:
                        seen.add((where, at))
                        found |= self.tests(where, at, seen)
        return found

    def chosen(self, name, line, function, seconds):
        """Names of tests that take so many seconds together, file by file.

        First those of the mirrored folder and of files that mention the function, the quickest of them first; last
        what else such a file has, since a fixture is executed by the first of its tests and judged by the rest.
        """
        folder, word = f"tests/{Path(name).parent}", re.compile(rf"\b{re.escape(function or Path(name).stem)}\b")

        @cache
        def close(file):
            return str(Path(file).parent) == folder or bool(word.search(_text(self.root / file)))

        there = sorted((test for test in self.seconds if self._is_there(test)), key=self.seconds.get)
        tests = self.tests(name, line)
        first = [test for test in there if test in tests and close(_file(test))]
        files = set(map(_file, first))
        others = [test for test in there if test in tests and _file(test) not in files]
        rest = [test for test in there if test not in tests and _file(test) in files]
        kept = self._up_to(seconds * (1 - OTHERS * bool(others)), first, [])
        kept = self._up_to(seconds, rest, self._up_to(seconds, others, kept))
        order = list(dict.fromkeys(map(_file, kept)))[:FILES]
        return [test for file in order for test in kept if _file(test) == file]

    def _up_to(self, seconds, tests, kept):
        left = seconds - sum(map(self.seconds.get, kept))
        sums = accumulate(map(self.seconds.get, tests))
        more = [test for test, total in zip(tests, sums, strict=True) if total < left]
        return kept + (more or ([] if kept else tests[:1]))

    def _is_there(self, test):
        return f"def {test.split('::')[-1].split('[')[0]}(" in _text(self.root / _file(test))


def _node(classname, name):
    """What pytest calls a test, of what it writes to its XML; test classes are not used here"""
    return f"{classname.replace('.', '/')}.py::{name}"


def _file(test):
    return test.split("::")[0]


@cache
def _text(file):
    return file.read_text(encoding="utf-8") if file.exists() else ""


@cache
def _tree(file):
    return ast.parse(file.read_text(encoding="utf-8"))


def _statement(tree, line):
    """Lines of the statement at a line (of a compound one, its head), what others call it, whether in a function"""
    inner, around = None, []
    for node in ast.walk(tree):  # outer ones first
        if isinstance(node, ast.stmt) and _first(node) <= line <= node.end_lineno:
            inner = node
            if isinstance(node, ast.FunctionDef | ast.ClassDef):
                around.append(node)
    inside = any(isinstance(node, ast.FunctionDef) for node in around)
    if around:
        symbols = [around[-1].name]
        if len(around) > 1 and isinstance(around[-2], ast.ClassDef) and symbols[0].startswith("__"):
            symbols = [around[-2].name]
    else:
        targets = getattr(inner, "targets", None) or [getattr(inner, "target", None)]
        symbols = [n.id for target in targets if target for n in ast.walk(target) if isinstance(n, ast.Name)]
    last = inner.body[0].lineno - 1 if getattr(inner, "body", None) else inner.end_lineno
    return range(inner.lineno, max(last, inner.lineno) + 1), symbols, inside


def _first(node):
    return min([node.lineno, *(one.lineno for one in getattr(node, "decorator_list", ()))])


@cache
def _mentions(tree, symbol):
    """Lines that read a name, imports and definitions not counted"""
    return [
        node.lineno
        for node in ast.walk(tree)
        if (isinstance(node, ast.Name) and node.id == symbol and isinstance(node.ctx, ast.Load))
        or (isinstance(node, ast.Attribute) and node.attr == symbol)
    ]
