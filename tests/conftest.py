"""`--seconds N`: no test begins later than that; those that are left are skipped and counted."""

import time

import pytest

_START = time.monotonic()


def pytest_addoption(parser):
    parser.addoption("--seconds", type=float, help="begin no test later than this many seconds after the start")


@pytest.hookimpl(tryfirst=True)  # before its fixtures are made
def pytest_runtest_setup(item):
    seconds = item.config.getoption("seconds")
    if seconds is not None and time.monotonic() - _START > seconds:
        pytest.skip(f"not begun after {seconds:g} s")
