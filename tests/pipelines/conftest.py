"""What tests of several commands share."""

import signal

import pytest


@pytest.fixture
def heard():
    """Ctrl-C as at a terminal, also where tests run in the background and inherit that it is ignored"""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
