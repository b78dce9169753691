"""What tests of several commands share."""

import json
import signal

import pytest

from hakobune.pipelines.cli import main


@pytest.fixture
def heard():
    """Ctrl-C as at a terminal, also where tests run in the background and inherit that it is ignored"""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def asked(capsys):
    """Tables {title, rows} of a command called with --json, and all its other lines; status : that it ends with"""

    def call(*words, status=0):  # status None: whatever it is
        capsys.readouterr()
        ended = main([*map(str, words), "--json"])
        assert ended == status or status is None
        out, said = capsys.readouterr()
        return [json.loads(line) for line in out.splitlines()], said

    return call


@pytest.fixture
def pictures(monkeypatch):
    """Figures that commands save, as they come, in place of their files"""
    from matplotlib.figure import Figure

    made = []

    def kept(figure, file, **_):
        made.append(figure)
        file.write(b"a picture")

    monkeypatch.setattr(Figure, "savefig", kept)
    return made
