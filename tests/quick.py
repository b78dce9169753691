"""Tests that a change touches, the nearest first, for a minute and a half: `make test-quick`.

    python tests/quick.py [--against main] [--seconds 70] [--files 60] [--processes 2] [--list]

The change is what differs from where this branch left `--against`, and what is not committed.  A file of data counts as
the modules of its folder; pages are tested by the tests of the guide.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parent)]

from near import PACKAGES, ROOT, nearest

PAGES = ("test_readme.py", "test_guide.py", "test_architecture_page.py")


def git(*words):
    return subprocess.run(["git", *words], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def changed(against):
    """Paths of what differs from where this branch left another, deleted files not"""
    left = git("merge-base", against, "HEAD").strip()
    names = git("diff", "--name-only", "--diff-filter=d", left).splitlines()
    names += git("ls-files", "--others", "--exclude-standard").splitlines()
    return [ROOT / name for name in names]


def functions(against):
    """Names of the functions and classes in which something differs, whose mention brings a test nearer"""
    text = git("diff", "-U0", git("merge-base", against, "HEAD").strip())
    return sorted(set(re.findall(r"^(?:@@.*@@|[+-])\s*(?:def|class) (\w+)", text, re.MULTILINE)))


def sources(files):
    """Modules that files stand for: themselves, or those of their folder for data"""
    found = set()
    for file in files:
        inside = file.relative_to(ROOT).parts[0] in (*PACKAGES, "tests")
        if inside:
            found |= {file} if file.suffix == ".py" else set(file.parent.glob("*.py"))
    return found


def chosen(files, names=()):
    tests = nearest(sources(files), names)
    if any(file.suffix == ".md" for file in files):
        tests += [ROOT / "tests" / page for page in PAGES if ROOT / "tests" / page not in tests]
    return tests


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--against", default="main", help="the branch that this one left")
    parser.add_argument("--seconds", type=float, default=70, help="no test begins later after all are collected")
    parser.add_argument(
        "--files", type=int, default=60, help="at most so many files of tests: all take 20 s to collect"
    )
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--list", action="store_true", help="only print the files of tests, the nearest first")
    given = parser.parse_args()
    tests = [str(test.relative_to(ROOT)) for test in chosen(changed(given.against), functions(given.against))]
    left_out, tests = tests[given.files :], tests[: given.files]
    if given.list or not tests:
        print("\n".join(tests) or f"no test is near what differs from {given.against}")
        return 0
    more = f"; {len(left_out)} farther ones are left to make test" if left_out else ""
    print(f"{len(tests)} files of tests are near what differs from {given.against}, {tests[0]} first{more}", flush=True)
    spread = ["-n", str(given.processes), "--dist", "loadfile", "--no-loadscope-reorder"]
    words = [sys.executable, "-m", "pytest", "--seconds", f"{given.seconds:g}", *spread, *tests]
    return subprocess.run(words, cwd=ROOT).returncode


if __name__ == "__main__":
    sys.exit(main())
