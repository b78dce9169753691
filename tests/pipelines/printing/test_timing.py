"""The timeline of a command."""

from hakobune.pipelines.cli import main
from hakobune.pipelines.printing.timing import REST, Timeline


def test_a_phase_leaves_out_the_phases_within_it_and_all_add_up_to_the_whole():
    now = [0.0]
    timeline = Timeline(lambda: (now[0], now[0] / 2))

    def wait(seconds):
        now[0] += seconds

    wait(1)
    with timeline.phase("solve"):
        wait(2)
        with timeline.phase("imports"):
            wait(4)
        wait(8)
    timeline.share("solve", "estimate", 4.0)
    wait(16)
    *_, whole = timeline.lines()
    assert timeline.seconds == {REST: (17.0, 8.5), "imports": (4.0, 2.0), "solve": (6.0, 3.0), "estimate": (4.0, 2.0)}
    assert whole.split()[1:5:2] == ["31.000", "15.500"]


def test_a_command_tells_its_phases_on_stderr_and_a_fault_too(tmp_path, capsys):
    sizes = ["--length", "4", "--beam", "2", "--draft", "1", "--depth", "9", "--omega", "1,1.1", "--heading", "0"]
    assert main(["box", *sizes, "--timing", "--output", str(tmp_path / "box.h5")]) == 0
    said = capsys.readouterr()
    for name in ("solve", "estimate", "store", "report", "whole"):
        assert any(line.startswith(name) for line in said.err.splitlines())
    assert "of processor" not in said.out
    assert main(["plot", str(tmp_path / "none.h5"), "--timing"]) == 2
    assert "whole" in capsys.readouterr().err
