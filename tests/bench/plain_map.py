"""A map of the tests that execute lines of kernels, made with kernels as plain Python, which coverage.py can see.

    PYTHONPATH=.:tests:build/coverage python tests/bench/plain_map.py FOLDER [tests/mooring tests/bem/test_waves.py ...]

FOLDER gets `.coverage` and `times.xml`, as `covered.py` reads them.  A test that has not ended after two seconds is
left out, and so is what needs its fixture: as plain Python a kernel takes a hundred times as long.  Each file of tests
runs in a fork of this process; it may take half a minute of processor time.
"""

import os
import resource
import signal
import sys
import time
from pathlib import Path
from xml.sax.saxutils import quoteattr

EACH, FILE = 2, 30  # seconds of a test, of processor time of a file


class Timed:
    """A plugin of pytest: coverage by test, and how long those took that passed"""

    def __init__(self, coverage):
        self.coverage, self.seconds = coverage, {}

    def pytest_runtest_logstart(self, nodeid):
        self.coverage.switch_context(nodeid)
        signal.setitimer(signal.ITIMER_REAL, EACH, 1)

    def pytest_runtest_logreport(self, report):
        if report.when == "call" and report.passed:
            self.seconds[report.nodeid] = report.duration

    def pytest_runtest_logfinish(self):
        signal.setitimer(signal.ITIMER_REAL, 0)


def _too_long(*_):
    raise TimeoutError


def one_file(file, folder):
    """Run one file of tests and leave its part of the map; does not return, for threads may still be at work"""
    import coverage
    import pytest

    resource.setrlimit(resource.RLIMIT_CPU, (FILE, FILE))
    signal.signal(signal.SIGALRM, _too_long)
    packages = [f"{name}/*" for name in ("bem", "mooring", "meshing", "pipelines")]
    measured = coverage.Coverage(data_file=str(folder / f".part.{os.getpid()}"), include=packages)
    plugin = Timed(measured)
    measured.start()
    pytest.main(["-q", "--tb=no", "-p", "no:cacheprovider", file], plugins=[plugin])
    measured.stop()
    measured.save()
    cases = [
        f"<testcase classname={quoteattr(test.split('::')[0][:-3].replace('/', '.'))}"
        f' name={quoteattr(test.split("::", 1)[1])} time="{seconds:.3f}"/>\n'
        for test, seconds in plugin.seconds.items()
    ]
    with (folder / "times.xml").open("a") as times:
        times.write("".join(cases))
    os._exit(0)


def main():
    os.environ["NUMBA_DISABLE_JIT"] = "1"
    folder, places = Path(sys.argv[1]), sys.argv[2:] or ["tests/mooring", "tests/bem"]
    folder.mkdir(parents=True, exist_ok=True)
    paths = (path for place in map(Path, places) for path in ([place] if place.is_file() else place.rglob("test_*.py")))
    files = sorted(map(str, paths))
    import coverage
    import h5py  # noqa: F401 - loaded once, for all forks
    import pytest  # noqa: F401
    import scipy.optimize  # noqa: F401

    (folder / "times.xml").write_text("<suite>\n")
    for file in files:
        start = time.monotonic()
        if not (child := os.fork()):
            one_file(file, folder)
        print(f"{file}: {os.waitpid(child, 0)[1]}, {time.monotonic() - start:.0f} s", flush=True)
    with (folder / "times.xml").open("a") as times:
        times.write("</suite>\n")
    whole = coverage.Coverage(data_file=str(folder / ".coverage"))
    whole.combine([str(part) for part in folder.glob(".part.*")])
    whole.save()


if __name__ == "__main__":
    main()
