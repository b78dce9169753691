"""`--from-both-ends`: how tests are spread over processes; `--seconds N`: none begins later after all are collected.

Most of the time of a suite in a fresh clone is compilation, and a fixture of a file is made by each process that runs
some test of it.  Processes therefore take whole files, from either end of an order in which neighbours use the same
kernels and databases, and meet inside it.
"""

import gc
import time

import pytest

ROOMS = ("bem", "identities", "meshing", "bench", "pipelines", "mooring")  # kernels of panels first, of lines last


def pytest_addoption(parser):
    parser.addoption("--seconds", type=float, help="begin no test later than this many seconds after all are collected")
    parser.addoption("--from-both-ends", action="store_true", help="give whole files to processes, from two ends")


def pytest_collection_finish(session):
    session.config.collected = time.monotonic()
    gc.freeze()  # ten thousand tests and what they import stay to the end: not to be gone through again and again


@pytest.hookimpl(tryfirst=True)  # before its fixtures are made
def pytest_runtest_setup(item):
    seconds = item.config.getoption("seconds")
    if seconds is not None and time.monotonic() - item.config.collected > seconds:
        pytest.skip(f"not begun after {seconds:g} s")


@pytest.hookimpl(optionalhook=True)  # of pytest-xdist
def pytest_xdist_make_scheduler(config, log):
    if not config.getoption("from_both_ends"):
        return None
    from xdist.scheduler import LoadFileScheduling

    class FromBothEnds(LoadFileScheduling):
        def _assign_work_unit(self, node):
            files = sorted(self.workqueue, key=room)
            last = int(node.gateway.id.removeprefix("gw")) % 2
            self.workqueue.move_to_end(files[-last], last=False)
            super()._assign_work_unit(node)

    config.option.loadscopereorder = False
    return FromBothEnds(config, log)


def room(file):
    """Place of a file of tests in the order: its room, those of the house itself before those of commands"""
    name = file.split("/")[1] if file.count("/") > 1 else "bench"
    return ROOMS.index(name), file
