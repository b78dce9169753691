"""Files that a command is asked for are there when nobody reads what it prints, as behind `| head -1`."""

import io
import shutil
import sys

import pytest

from hakobune.pipelines import cli
from hakobune.pipelines.keys.kinds import SCENES


class Left(io.StringIO):
    """A pipe whose reader has gone"""

    def write(self, text):
        raise BrokenPipeError


@pytest.mark.parametrize(
    ("words", "files"),
    [
        (["berth", "berth_tanker.toml", "--output", "a.csv", "--plot", "a.png"], ("a.csv", "a.png")),
        (["earthquake", "earthquake_box.toml", "--plot", "a.png"], ("a.png",)),
        (["lines", "lines_barge.toml", "--plot", "a.png"], ("a.png",)),
        (["fender", "--family", "cell", "--height", "2", "--plot", "a.png"], ("a.png",)),
        (["line", "--type", "R3 studless 76 mm", "--length", "100", "--depth", "20", "--tension", "100",
          "--plot", "a.png", "--output", "a.csv"], ("a.csv", "a.png")),
    ],
)  # fmt: skip
def test_files_are_there_whoever_reads_what_is_printed(words, files, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if words[1].endswith(".toml"):
        shutil.copy(SCENES / words[1], tmp_path)
    monkeypatch.setattr(sys, "stdout", Left())
    with pytest.raises((OSError, SystemExit)):  # of the pipe, and of what asks it for its number
        cli.app(words, exit_on_error=False, print_error=False)
    assert all((tmp_path / name).stat().st_size for name in files)
