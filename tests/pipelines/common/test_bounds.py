"""What asks for more memory, time or numbers than there are is refused before any work, in one line with a way out."""

import math
import os
import shutil
import tomllib
from pathlib import Path

import pytest
import tomli_w

from hakobune import pipelines
from hakobune.pipelines.cli import main
from hakobune.pipelines.common import bounds
from hakobune.pipelines.common.bounds import Pace, TooMuchError, check_memory, check_seconds, told, whole_number
from hakobune.pipelines.common.progress import duration

SCENES = Path(pipelines.__file__).parent / "scenes"
SEA = "sea --height 3 --mean-period 8 --record new.csv"
TOO_MUCH = {
    f"{SEA} --components 1000000000": "components at 7200 times need about 6.13e+03 GB",
    f"{SEA} --components 1{'0' * 4400}": "--components is '1000000000",
    f"{SEA} --duration 1e12": "allowed: 16 to 10000000",
    "sections --beam-draft 0.1:9:1000000000 --depth-draft 2 --xi 1": "--beam-draft has 1000000000 numbers; allowed: 2",
    "sections --beam-draft 1:9:9999 --depth-draft 2:3:9999 --xi 1:2:9999": "999700029999 sections need about 2e+06 GB",
    "stress --scenes 1000000000000": "1000000000000 scenes take about 1.6e+04 years; allowed: 30 days",
    "bench --threads 1000000000": "--threads is '1000000000'; allowed: different whole numbers",
    "line-dynamics line.toml --duration 1e12": "1e+12 s of 40 elements need about",
    "line-dynamics line.toml --tolerance 1e-300": "tolerance is 1e-300; allowed: 1e-08 to 0.1",
    "line-dynamics fine.toml": "1000000000 elements need about 2e+03 GB",
    f"lines line.toml --offset 1 --direction {'1,' * 500}1": "--direction has 501 numbers; allowed: 1 to 360",
    "solve --mesh large.gdf --depth 20 --omega 1": "large.gdf has 1000 MB; allowed: up to 32 MB",
    "lines large.toml": "large.toml has 1000 MB; allowed: up to 8 MB",
    "sea large.csv": "large.csv has 1000 MB; allowed: up to 256 MB",
    "sea loop.csv": "loop.csv",
    "check pipe.h5": "pipe.h5 is not a file",
    "check pipe.csv": "pipe.csv cannot be read: it is a device or a pipe",
}


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copy(SCENES / "line_chain_60m.toml", "line.toml")
    fine = tomllib.loads(Path("line.toml").read_text())
    fine["segments"][0]["elements"] = 10**9
    Path("fine.toml").write_text(tomli_w.dumps(fine))
    for suffix in ("gdf", "toml", "csv"):
        with open(f"large.{suffix}", "wb") as file:
            file.truncate(10**9)  # takes no room
    os.symlink("loop.csv", "loop.csv")
    os.mkfifo("pipe.h5")
    os.mkfifo("pipe.csv")


@pytest.mark.parametrize("line", TOO_MUCH, ids=lambda line: line[:60])
def test_too_much_is_refused_in_one_line_and_leaves_nothing(line, here, capsys):
    before = sorted(os.listdir())
    assert main(line.split()) == 2
    said = capsys.readouterr().err
    assert TOO_MUCH[line] in said and said.count("\n") == 1, said
    assert sorted(os.listdir()) == before


def test_memory_is_held_against_what_is_free(monkeypatch):
    monkeypatch.setattr(bounds, "available_memory", lambda: 2e9)
    check_memory("a thing needs", 1.9e9, "buy more")
    with pytest.raises(TooMuchError, match=r"^a thing needs about 2.1 GB, and 2.0 GB are free; buy more$"):
        check_memory("a thing needs", 2.1e9, "buy more")


@pytest.mark.parametrize("seconds", [31 * 86400.0, 1e300, math.inf, math.nan])
def test_what_takes_longer_than_a_month_is_refused(seconds):
    check_seconds("it takes", 29 * 86400.0, "less")
    with pytest.raises(TooMuchError, match=r"^it takes about .*; allowed: 30 days; less$"):
        check_seconds("it takes", seconds, "less")


def test_only_what_takes_long_is_told(capsys):
    told("it takes", 9.0)
    told("it takes", 3700.0)
    assert capsys.readouterr().err == "it takes about 1 h 01 min\n"
    assert [duration(x) for x in (5e5, 1e9, math.inf)] == ["5 days", "32 years", "inf years"]


def test_a_pace_tells_once_what_all_will_take_and_then_what_is_left(monkeypatch):
    clock, said = iter([50.0, 50.5, 51.1, 61.5, 62.0]), []
    monkeypatch.setattr(bounds.time, "perf_counter", lambda: next(clock))
    pace = Pace("100 things take", 100, "give fewer", said.append)
    for _ in range(5):
        pace.step()
    assert said == ["100 things take about 55 s", "4 of 100, 6 min 12 s left"]


def test_much_memory_is_told_of_work_that_is_short():
    said = []
    told("2618 responses take", 2.0, said.append, memory=7.6e9)
    told("26 responses take", 2.0, said.append, memory=7.6e7)
    assert said == ["2618 responses take about 2 s, 7.6 GB"]


def test_a_pace_that_lasts_longer_than_a_month_ends_the_work(monkeypatch):
    clock = iter([0.0, 2.0])
    monkeypatch.setattr(bounds.time, "perf_counter", lambda: next(clock))
    pace = Pace("10000000 things take", 10**7, "give fewer")
    pace.step()
    with pytest.raises(TooMuchError, match=r"10000000 things take about 231 days; allowed: 30 days; give fewer"):
        pace.step()


@pytest.mark.parametrize("text", ["-1", "1.5", "", "²", "1" * 16, "٣"])
def test_a_flag_that_is_no_whole_number_is_refused(text):
    with pytest.raises(ValueError, match=r"--count is .*allowed: a whole number from 0"):
        whole_number("count", text)
    assert whole_number("count", "12") == 12 and whole_number("count", None, otherwise=3) == 3
