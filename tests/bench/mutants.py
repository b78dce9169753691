"""Small faults put into code that commands reach, and which of them the tests notice.

    python tests/bench/mutants.py --seed 61 --count 25 --package mooring --results /tmp/mutants.jsonl

A fault (mutant) is a changed source file in a clone of the last commit, in a temporary folder with compiled kernels of
its own; the checkout is not touched.  Tests nearest to the file run first (`tests/near.py`), up to the first that
fails; none begins after --timeout seconds (more where others use the machine), and what has not ended after three
times as long of processor time is tried again for five times as long, and counts as noticed, as one that hangs, where
it ends without the fault.  Tests that failed are run once without any fault, so that none counts that fails anyway.
What lives through the near ones is tried again with --wider seconds.

--coverage MAP --times XML : tests that execute the line come first, by a map of the suite (`covered.py` tells how to
make one).

Results are lines of JSON, one a mutant; a second call with the same file goes on where the first stopped.  Mutants
that change nothing a test could notice are in `mutants_equivalent.toml`, with the reason.
--plain FOLDER : faults in files that hold kernels are judged with kernels as plain Python, which need no compilation,
by the tests that execute the line so: a map that `plain_map.py` makes.  --again without it compiles what lived.
"""

import argparse
import ast
import copy
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from fnmatch import fnmatch
from importlib import import_module
from itertools import chain, zip_longest
from pathlib import Path
from types import ModuleType

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

from bench.covered import Covered
from near import PACKAGES, ROOT, nearest

from hakobune.bem.kernels.jit import cache_folder
from hakobune.bem.kernels.sources import Sources
from hakobune.pipelines.cli import ELSEWHERE

TWINS = (
    "sin cos",
    "sinh cosh",
    "min max",
    "minimum maximum",
    "argmin argmax",
    "floor ceil",
    "length beam",
    "roll pitch",
)
TWINS += (
    "surge sway",
    "lower upper",
    "first last",
    "start end",
    "real imag",
    "x y",
    "mean max",
    "amax amin",
    "any all",
)
TWIN = {a: b for pair in TWINS for a, b in (pair.split(), pair.split()[::-1])}
SYMMETRIC = ("hypot", "max", "min", "maximum", "minimum", "isclose", "gcd")
FLIPPED = {ast.Lt: ast.Gt, ast.Gt: ast.Lt, ast.LtE: ast.GtE, ast.GtE: ast.LtE, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq}
SIGN = {ast.Add: ast.Sub, ast.Sub: ast.Add}
BUSIEST = 4.0  # times as long, on a machine that others use
HANGS = 5  # times as long, to tell what hangs from what is slow
USAGE = 4  # pytest's status where a name of a test is not known: nothing was run
MIRRORS = 2  # files of tests that are nearest to a kernel, of which coverage sees the calls alone
NEAR, WIDER = 12, 60  # files of tests, all of which are collected before any runs: 150 take 20 s
ROUNDING = 1e-5  # constants below are tolerances on rounding, of which a tenth more changes nothing
LIBRARIES = "pytest numpy scipy.interpolate scipy.optimize scipy.signal scipy.spatial h5py msgspec rich.table numba"
SILENT = (ast.Raise, ast.Import, ast.ImportFrom, ast.arguments, ast.Assert)  # what is inside is not drawn


def number(node):
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)


def expressions(node):
    """(operator, expression in place of `node`) of every fault of one expression"""
    if isinstance(node, ast.BinOp):
        if type(node.op) in SIGN:
            yield "sign", ast.BinOp(node.left, SIGN[type(node.op)](), node.right)
            yield "term dropped", node.left
            yield "term dropped", node.right
        if isinstance(node.op, ast.Mult | ast.Div):
            yield "factor 2", ast.BinOp(ast.Constant(2), ast.Mult(), node)
            yield "factor dropped", node.left
        if isinstance(node.op, ast.Pow) and number(node.right):
            yield "power", ast.BinOp(node.left, ast.Pow(), ast.Constant(node.right.value + 1))
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub) and not number(node.operand):
        yield "sign", node.operand
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield "comparison", node.operand
    elif isinstance(node, ast.Compare) and type(node.ops[0]) in FLIPPED:
        yield "comparison", ast.Compare(node.left, [FLIPPED[type(node.ops[0])](), *node.ops[1:]], node.comparators)
    elif isinstance(node, ast.BoolOp):
        yield "term dropped", node.values[0]
        yield "term dropped", node.values[-1]
    elif isinstance(node, ast.Constant) and type(node.value) is float and abs(node.value) > ROUNDING:
        yield "constant", ast.Constant(node.value * 1.1)
    elif isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load):
        if isinstance(node.slice, ast.Constant) and type(node.slice.value) is int:
            yield "index", ast.Subscript(node.value, ast.Constant(node.slice.value + 1), node.ctx)
        elif isinstance(node.slice, ast.Name):
            yield "index", ast.Subscript(node.value, ast.BinOp(node.slice, ast.Sub(), ast.Constant(1)), node.ctx)
    elif isinstance(node, ast.Call):
        yield from _calls(node)
    elif isinstance(node, ast.Name) and node.id in TWIN and isinstance(node.ctx, ast.Load):
        yield "twin", ast.Name(TWIN[node.id], node.ctx)


def _calls(node):
    places = [i for i, (a, b) in enumerate(zip(node.args, node.args[1:], strict=False)) if _plain(a, b)]
    for i in () if _symmetric(node) else places:
        swapped = [*node.args[:i], node.args[i + 1], node.args[i], *node.args[i + 2 :]]
        yield "names swapped", ast.Call(node.func, swapped, node.keywords)
    if isinstance(node.func, ast.Attribute) and node.func.attr in TWIN:
        twin = ast.Attribute(node.func.value, TWIN[node.func.attr], node.func.ctx)
        yield "twin", ast.Call(twin, node.args, node.keywords)
    if isinstance(node.func, ast.Attribute) and node.func.attr in ("sqrt", "abs", "conj", "radians", "degrees"):
        yield "function dropped", node.args[0] if node.args else node.func.value


def _symmetric(node):
    """Whether a call has the same value whichever of its arguments is first"""
    return getattr(node.func, "attr", getattr(node.func, "id", "")) in SYMMETRIC


def _plain(a, b):
    return isinstance(a, ast.Name) and isinstance(b, ast.Name) and a.id != b.id


def faults(source):
    """(operator, line, text before, text after, first byte, last byte, function) of every fault of a source file"""
    tree, offsets = ast.parse(source), _offsets(source)
    found = []

    def place(node):
        first = offsets[node.lineno - 1] + node.col_offset
        return first, offsets[node.end_lineno - 1] + node.end_col_offset

    def visit(node, function, whole):
        """whole : the string with fields that this is in, of whose parts Python tells no places"""
        if isinstance(node, SILENT):
            return
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            function = node.name
            children = node.body
        elif isinstance(node, ast.AnnAssign):
            children = [node.value] if node.value is not None and function.islower() else []
        else:
            children = ast.iter_child_nodes(node)
        if isinstance(node, ast.expr):
            whole = whole or (node if isinstance(node, ast.JoinedStr) else None)
            for name, new in expressions(node):
                at = whole or node
                if whole:
                    new = _replaced(whole, node, new)
                text = ast.unparse(ast.fix_missing_locations(new))
                after = text if whole else f"({text})"
                first, last = place(at)
                found.append((name, node.lineno if not whole else whole.lineno, first, last, after, function))
        elif isinstance(node, ast.stmt):
            for name, first, last, after in _statements(node, place, source):
                found.append((name, node.lineno, first, last, after, function))
        for child in children:
            visit(child, function, whole)

    visit(tree, "", None)
    return found


def _replaced(whole, node, new):
    """A copy of a tree with one node replaced"""
    index = next(i for i, other in enumerate(ast.walk(whole)) if other is node)
    twin = copy.deepcopy(whole)
    target = list(ast.walk(twin))[index]

    class Replace(ast.NodeTransformer):
        def visit(self, other):
            return new if other is target else self.generic_visit(other)

    return Replace().visit(twin)


def _statements(node, place, source):
    if isinstance(node, ast.AugAssign) or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)):
        yield "statement dropped", *place(node), "pass"
    elif isinstance(node, ast.For):
        last = node.body[-1]
        end, column = place(last)[1], node.body[0].col_offset
        if node.body[0].lineno > node.lineno and not isinstance(last, ast.Return | ast.Raise | ast.Continue):
            yield "early end", end, end, "\n" + " " * column + "break"
    elif isinstance(node, ast.If) and len(node.body) == 1 and isinstance(node.body[0], ast.Return) and not node.orelse:
        yield "early return dropped", *place(node.body[0]), "pass"


def _offsets(source):
    offsets = [0]
    for line in source.encode().splitlines(keepends=True):
        offsets.append(offsets[-1] + len(line))
    return offsets


def changed(source, first, last, after):
    data = source.encode()
    return (data[:first] + after.encode() + data[last:]).decode()


def drawn(seed, count, package, root, equivalent):
    """Mutants of a package in random order: each line of code that commands reach is as likely as any other"""
    rooms = [place.partition(":")[0].replace(".", "/") + ".py" for place in ELSEWHERE]
    reached = {file for start in ("cli.py", *rooms) for file in Sources(root).of(root / "pipelines" / start)}
    files = sorted(file for file in map(Path, reached) if root / package in file.parents)
    skipped = equivalent.get("files", {})
    lines = {}
    for file in files:
        name = str(file.relative_to(root))
        if any(fnmatch(name, pattern) for pattern in skipped):
            continue
        source = file.read_text(encoding="utf-8")
        for operator, line, first, last, after, function in faults(source):
            text = source.encode()[first:last].decode()
            row = {
                "file": name,
                "line": line,
                "function": function,
                "operator": operator,
                "before": text,
                "after": after,
            }
            lines.setdefault((name, line), []).append(row | {"first": first, "last": last})
    draw = random.Random(f"{seed} {package}")
    places = sorted(lines)
    draw.shuffle(places)
    rows = [draw.choice(lines[place]) for place in places]
    known = [(row, row.get("function")) for row in equivalent.get("mutant", ())]

    def changes_nothing(row):
        return any(
            (row["file"], row["before"], row["after"].strip("()"))
            == (one["file"], one["before"], one["after"].strip("()"))
            and function in (None, row["function"])
            for one, function in known
        )

    return [row for row in rows if not changes_nothing(row)][:count]


class Clone:
    """The last commit in a folder of its own, where faults are put in"""

    def __init__(self, folder):
        self.root = folder / "clone"
        if not self.root.exists():
            subprocess.run(["git", "clone", "-q", "--shared", str(ROOT), str(self.root)], check=True)
        commit = subprocess.run(
            ["git", "rev-parse", "HEAD"], cwd=ROOT, check=True, capture_output=True, text=True
        ).stdout
        for words in (["checkout", "-q", "--", "."], ["checkout", "-q", "--detach", commit.strip()]):
            subprocess.run(["git", *words], cwd=self.root, check=True)
        modules = [file for package in PACKAGES for file in (self.root / package).rglob("*.py")]
        self.sound = {cache_folder(file, self.root).name for file in modules if "@kernel" in file.read_text("utf-8")}
        self.kernels = folder / "kernels"
        os.environ |= {
            "HAKOBUNE_CACHE": str(self.kernels),
            "PYTHONPATH": os.pathsep.join((str(self.root), str(self.root / "tests"))),
            "OPENBLAS_NUM_THREADS": "1",
            "OMP_NUM_THREADS": "1",
        }

    def tests(self, files, seconds, limit=None, plain=False):
        """(status, output, seconds) of tests run up to the first that fails; status None if they hang: by `limit`

        seconds of processor time (three times `seconds` and a minute without it).  plain : kernels as plain Python

        They run in a fork of this process, which has the libraries in memory: to load them takes as long as most tests.
        """
        limit = round(limit or 3 * seconds + 60)  # of the processor, however busy the machine is
        seconds *= min(BUSIEST, max(1.0, os.getloadavg()[0] / os.cpu_count()))
        words = ["-x", "-v", "--tb=no", "-rfE", "--seconds", f"{seconds:g}", *map(str, files)]
        for name in LIBRARIES.split():
            import_module(name)
        start = time.monotonic()
        with tempfile.TemporaryFile("w+") as output:
            child = os.fork()
            if not child:
                resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
                self._become(words, output, plain)
            status = _status(child, start + BUSIEST * limit)
            output.seek(0)
            tail = output.read().splitlines()
        return status, tail, time.monotonic() - start

    def _become(self, words, output, plain):
        """Turn a fork of this process into one of pytest in the clone"""
        os.setsid()
        os.environ["NUMBA_DISABLE_JIT"] = str(int(plain))
        import_module("numba").config.reload_config()
        for stream in (1, 2):
            os.dup2(output.fileno(), stream)
        os.chdir(self.root)
        own = [name for name, module in sys.modules.items() if str(ROOT) in (getattr(module, "__file__", "") or "")]
        for name in own:
            del sys.modules[name]
        sys.modules["__main__"] = ModuleType("__main__")  # processes that tests spawn would import this file
        sys.path[:] = os.environ["PYTHONPATH"].split(os.pathsep) + [p for p in sys.path if not p.startswith(str(ROOT))]
        status = 3
        try:
            status = import_module("pytest").main(words)
            sys.stdout.flush()
        finally:
            os._exit(status)

    def with_fault(self, row, files, seconds, limit=None, plain=False):
        path = self.root / row["file"]
        before, stamp = path.read_text(encoding="utf-8"), path.stat()
        self._forget(path)
        path.write_text(changed(before, row["first"], row["last"], row["after"]), encoding="utf-8")
        try:
            return self.tests(files, seconds, limit, plain)
        finally:
            path.write_text(before, encoding="utf-8")
            os.utime(path, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))  # numba looks at it
            self._forget(path)

    def _forget(self, path):
        """Remove what was compiled of a fault: Python sees no second change of a file within a second"""
        for file in path.parent.glob(f"__pycache__/{path.stem}.*"):
            file.unlink()
        for folder in self.kernels.glob("*"):
            if folder.is_dir() and folder.name not in self.sound:
                shutil.rmtree(folder)


def _status(child, until):
    """How a process ended; None if it had to be"""
    while not (ended := os.waitpid(child, os.WNOHANG))[0]:
        if time.monotonic() > until:
            os.killpg(child, signal.SIGKILL)
            os.waitpid(child, 0)
            return None
        time.sleep(0.02)
    status = os.waitstatus_to_exitcode(ended[1])
    return None if status in (-signal.SIGXCPU, -signal.SIGKILL) else status


def judged(clone, row, given, sound, covered=None, plain=None):
    """A row with its verdict: `noticed` by a test that passes without the fault, or `lived`"""
    names, more = (row["function"], Path(row["file"]).stem), []
    files = [str(f.relative_to(clone.root)) for f in nearest([clone.root / row["file"]], names, clone.root)]
    rounds = [(given.timeout, files[:NEAR], False), (given.wider, files[:WIDER], False)]
    if covered:
        tests = covered.chosen(row["file"], row["line"], row["function"], given.timeout)
        if not covered.direct(row["file"], row["line"]):
            tests = files[:MIRRORS] + [test for test in tests if test.split("::")[0] not in files[:MIRRORS]]
        known = {test.split("::")[0] for test in tests}
        rounds[0] = given.timeout, tests + [file for file in files[:NEAR] if file not in known], False
    if plain and "@kernel" in (clone.root / row["file"]).read_text(encoding="utf-8"):
        rounds[0] = given.timeout, plain.chosen(row["file"], row["line"], row["function"], given.timeout), True
    spent = 0.0
    for seconds, tests, as_plain in chain(rounds, more):
        if not seconds or not tests:
            continue
        status, output, took = clone.with_fault(row, tests, seconds, plain=as_plain)
        if status == USAGE:  # a test of the map is there no more, or its file cannot be imported
            tests = list(dict.fromkeys(test.split("::")[0] for test in tests))
            status, output, took = clone.with_fault(row, tests, seconds, plain=as_plain)
        by = _stopped(status, output)
        spent += took
        if status is None and by:
            status, output, took = clone.with_fault(row, [by], seconds, HANGS * seconds, as_plain)
            spent += took
        if status in (0, 5):
            continue
        if status is None:
            by = f"it hangs in {by or 'the collection'}"
        else:
            by = _stopped(status, output) or "it does not import"
        passes = not _unknown(output) and _is_sound(clone, by.removeprefix("it hangs in "), given, sound, as_plain)
        if not passes and as_plain and by in tests:  # a test that needs compiled kernels says nothing here
            more.append((seconds, [test for test in tests if test != by], True))
            continue
        verdict = "noticed" if passes else "unsound test"
        return row | {"verdict": verdict, "by": by, "seconds": round(spent, 1), "tests": len(tests)}
    return row | {"verdict": "lived", "by": "", "seconds": round(spent, 1), "tests": len(rounds[0][1])}


def _stopped(status, output):
    """The test that failed or was at work at the end of pytest's output, or None"""
    failed = [line.split(" ", 1)[1].split(" - ")[0] for line in output if line.startswith(("FAILED ", "ERROR "))]
    if failed or status is not None:
        return failed[0] if failed else None
    running = [line for line in output if "::" in line]
    return re.sub(r"( [A-Z]+ .*)?\s*$", "", running[-1]) if running else None


def _unknown(output):
    """Whether pytest did not find a test that a map of another commit names, and ran none"""
    return any(line.startswith("ERROR: not found") for line in output) and not _stopped(1, output)


def _is_sound(clone, by, given, sound, plain):
    """Whether a test passes without any fault"""
    if "tests/" not in by:
        return True
    if (by, plain) not in sound:
        status = clone.tests([by], given.timeout, plain=plain)[0]
        if status not in (0, 1):  # a name that the command line does not find
            status = clone.tests([by.split("::")[0]], given.timeout, plain=plain)[0]
        sound[by, plain] = status == 0
    return sound[by, plain]


def told(row):
    before, after = (" ".join(row[name].split()) for name in ("before", "after"))
    return f"{row['file']}:{row['line']} {row['function']}: {row['operator']}: {before or '…'} → {after}"


def kept(path):
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.exists() else []


def summary(rows):
    for package in PACKAGES:
        own = [row for row in rows if row["file"].startswith(package + "/")]
        noticed = sum(row["verdict"] == "noticed" for row in own)
        if own:
            print(f"{package}: {noticed} of {len(own)} noticed, {100 * noticed / len(own):.0f} %")
    for row in rows:
        if row["verdict"] != "noticed":
            print(f"{row['verdict']}: {told(row)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=10, help="mutants of each package")
    parser.add_argument("--package", choices=PACKAGES, action="append", help="one or several; all without it")
    parser.add_argument("--timeout", type=float, default=40, help="seconds of near tests a mutant")
    parser.add_argument("--wider", type=float, default=0, help="seconds for another try of what lived; 0: none")
    parser.add_argument("--coverage", type=Path, help="which tests execute which line: see covered.py")
    parser.add_argument("--times", type=Path, default=Path("times.xml"), help="how long each of them takes")
    parser.add_argument("--plain", type=Path, help="folder of a map with kernels as plain Python: see plain_map.py")
    parser.add_argument("--folder", type=Path, default=Path(tempfile.gettempdir()) / "hakobune_mutants")
    parser.add_argument("--results", type=Path, help="lines of JSON; in --folder without it")
    parser.add_argument("--again", action="store_true", help="try again what lived, and nothing else")
    parser.add_argument("--list", action="store_true", help="only print what is drawn")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    path = given.results or given.folder / f"seed_{given.seed}.jsonl"
    equivalent = tomllib.loads((Path(__file__).parent / "mutants_equivalent.toml").read_text(encoding="utf-8"))
    clone = Clone(given.folder)
    rows, sound = kept(path), {}
    if given.again:
        waiting = [row for row in rows if row["verdict"] == "lived"]
        rows = [row for row in rows if row["verdict"] != "lived"]
        waiting = [now for row in waiting if (now := found_again(row, clone.root))]
    else:
        done = {(row["file"], row["before"], row["after"], row["function"]) for row in rows}
        packages = given.package or PACKAGES
        of_each = [drawn(given.seed, given.count, package, clone.root, equivalent) for package in packages]
        waiting = [
            row
            for row in chain.from_iterable(zip_longest(*of_each))  # one of each package in turn
            if row and (row["file"], row["before"], row["after"], row["function"]) not in done
        ]
    if given.list:
        print("\n".join(map(told, waiting)))
        return
    if given.again:
        path.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
    covered = Covered(given.coverage, given.times, clone.root) if given.coverage else None
    plain = Covered(given.plain / ".coverage", given.plain / "times.xml", clone.root) if given.plain else None
    for row in waiting:
        row = judged(clone, row, given, sound, covered, plain)
        rows.append(row)
        with path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row, ensure_ascii=False) + "\n")
        print(f"{row['verdict']} ({row['seconds']:.0f} s): {told(row)}  {row['by']}", flush=True)
    summary(rows)


def found_again(row, root):
    """A row with its place in the file as it is now, the nearest to where it was; None if that text is not there"""
    source = (root / row["file"]).read_text(encoding="utf-8")
    places = [
        (abs(line - row["line"]), line, first, last)
        for operator, line, first, last, after, function in faults(source)
        if (operator, after, function) == (row["operator"], row["after"], row["function"])
        and source.encode()[first:last].decode() == row["before"]
    ]
    if not places:
        return None
    _, line, first, last = min(places)
    return row | {"line": line, "first": first, "last": last}


if __name__ == "__main__":
    main()
