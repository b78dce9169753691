"""The tasks of the guide run as printed, one page after another's files, and print what they show."""

import re
import shlex
import shutil
from pathlib import Path

import pytest

from hakobune.pipelines import cli

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
TASKS = re.findall(r"\]\((\w+)\.md\) \|", (DOCS / "tasks.md").read_text(encoding="utf-8"))
BARGE = "--length 100 --beam 50 --draft 10 --depth 20 --gyration 15.6,29.4,32.3"
# what other tests run in a reduced form: minutes here
LONG = (
    "animate box.h5",
    "design design.toml",
    "downtime downtime.toml",
    "solve ship_n_port",
    "solve bodies_side_by_side",
    "simulate side_by_side",
    "solve bodies_bridge",
    "simulate bridge",
    "solve bodies_terminal",
    "passing passing_terminal",
    "simulate terminal",
    "simulate simulate_n_port",
    "sweep sweep_n_port",
    "box --length 100 --beam 50 --draft 10 --depth 20 --omega 0.3:1.8:31",  # panels
    "qtf shallow.h5",
    "import rm3.1",  # a file of WEC-Sim
)
GIVEN = {  # files that a page speaks of as there, and where they come from
    "mesh_file": ("hull.gdf",),
    "buoy": ("response.toml",),
}


def blocks(text):
    """[(commands, lines shown)] of a page: indented commands, and the text that follows them"""
    parts = re.split(r"```text\n(.*?)```", text.replace("\\\n", " "), flags=re.S)
    commands = [re.findall(r"^    (hakobune .*)$", part, re.M) for part in parts[::2]]
    return list(zip(commands, [*map(str.splitlines, parts[1::2]), []], strict=True))


def plain(text):
    """Words alone: no boxes, one space"""
    return " ".join(re.sub(r"[^\S ]|[|\u2500-\u257f]", " ", text).split())


def shown_to_fail(printed, page):
    """The status that a command of a page has to end with: 1 where what it prints fails and the page shows that"""
    failed = [one for one in printed.splitlines() if one.startswith("FAILS: ")]
    shown = re.findall(r"^FAILS: .*", (DOCS / f"{page}.md").read_text(encoding="utf-8"), re.M)
    return int(any(one.startswith(said) for one in failed for said in shown))


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    """The database of the first page"""
    place = tmp_path_factory.mktemp("barge") / "box.h5"
    (made,) = [line for (lines, _) in blocks((DOCS / "barge.md").read_text()) for line in lines if " box " in line]
    assert all(word in made for word in BARGE.split())
    assert cli.main([*shlex.split(made)[1:-1], str(place)]) == 0
    return place


@pytest.mark.parametrize("page", TASKS)
def test_a_task_runs_as_printed_and_prints_what_it_shows(page, database, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    shutil.copy(database, "box.h5")
    for name in GIVEN.get(page, ()):
        known = {"hull.gdf": ROOT / "meshes" / "box_100x50x10.gdf"}
        if name in known:
            shutil.copy(known[name], name)
        else:
            assert cli.main(["new", name.removesuffix(".toml")]) == 0
    told = ""
    for commands, shown in blocks((DOCS / f"{page}.md").read_text(encoding="utf-8")):
        for line in commands:
            words = shlex.split(line)[1:]
            if not " ".join(words).startswith(LONG):
                status = cli.main(words)
                output = capsys.readouterr()
                told += output.out + output.err
                assert status == shown_to_fail(output.out, page), f"{line}: {output.out} {output.err}"
        missing = [line for line in shown if plain(line) not in plain(told)]
        assert not missing, f"{missing} not in {told}"


def test_the_list_of_tasks_has_every_page():
    assert len(TASKS) == 15 and all((DOCS / f"{page}.md").is_file() for page in TASKS)


def test_files_of_the_four_jobs_are_those_that_their_commands_read(tmp_path):
    """Their runs take minutes: what the files hold is read, with fenders and ropes put in their places"""
    from hakobune.meshing.drawing import read_drawing
    from hakobune.mooring.studies.conditions import ExposedBox
    from hakobune.pipelines.berth.study import read_berth
    from hakobune.pipelines.moor.study import read_study
    from hakobune.pipelines.scene.scene import make_scene, read_scene
    from hakobune.pipelines.single_point.reading import read_study as read_point

    pages = sorted(DOCS.glob("job_*.md"))
    assert len(pages) == 4
    for page in pages:
        text = page.read_text(encoding="utf-8")
        for name, body in re.findall(r"`(\w+\.toml)`[^`]*?```toml\n(.*?)```", text, re.S):
            (tmp_path / name).write_text(body)
    ship = ExposedBox(225.0, 36.0, 13.0, 5.0)
    assert read_study(tmp_path / "study.toml")[0].spreads[0].length == 150.0
    assert len(read_study(tmp_path / "jetty.toml")[0].berth(ship, (0, 0, 0)).names) == 8
    assert make_scene(read_scene(tmp_path / "ship.toml")).body.block == 0.8 and read_berth(tmp_path / "berth.toml")
    assert cli.main(["new", "single-point-tanker", str(tmp_path / "calm.toml")]) == 0
    assert read_point(tmp_path / "calm.toml")[0].current.ship == "tanker"
    assert read_drawing(tmp_path / "barge.toml").volume == pytest.approx(
        24 * 4 * 80
    )  # a trapezium, 90 m above, 70 below
