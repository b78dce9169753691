"""What is said of a command that Ctrl-C ends at once, and when it is left to others or acts by itself."""

import signal
import time

import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.common import interrupt
from hakobune.pipelines.common.interrupt import ctrl_c

BOX = ["box", "--length", "10", "--beam", "5", "--draft", "1", "--depth", "5", "--omega", "1"]
STATES = "; finished states are stored, and the same command continues with the others"
KEPT = "; solved frequencies are stored, and the same command continues"


@pytest.mark.parametrize(
    ("words", "place", "said"),
    [
        (["plot", "box.h5"], "hakobune.bem.database.open_database", ""),
        (["look", "box.h5", "--plot", "box.png"], "hakobune.pipelines.view.looking.look", ""),
        (["sections"], "hakobune.pipelines.sections.result.tables", ""),
        ([*BOX, "--mesh-only"], "hakobune.pipelines.solve.hull.make_hull", ""),
        (BOX, "hakobune.pipelines.solve.run.solve", KEPT),
        (["downtime", "d.toml"], "hakobune.pipelines.downtime.study.read_downtime", STATES),
        (["compare", "sections"], "hakobune.pipelines.validation.comparisons.sets.solved", KEPT),
    ],
)
def test_only_of_what_is_stored_is_said_that_it_is(words, place, said, tmp_path, monkeypatch, capsys):
    def interrupted(*arguments, **named):
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(place, interrupted)
    assert main(words) == 130
    assert capsys.readouterr().err == f"hakobune {words[0]}: interrupted{said}\n"


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs timers")
def test_a_ctrl_c_that_nobody_heeds_acts_as_a_second_one_and_one_that_is_heeded_does_not(monkeypatch, heard):
    monkeypatch.setattr(interrupt, "PATIENCE", 0.02)
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt), ctrl_c() as stop:
        signal.raise_signal(signal.SIGINT)
        assert stop.asked
        time.sleep(5.0)
    with ctrl_c() as stop:
        signal.raise_signal(signal.SIGINT)
    time.sleep(0.05)
    assert stop.asked and signal.getsignal(signal.SIGINT) is before


def test_a_process_that_leaves_ctrl_c_to_its_parent_goes_on_to_do_so():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with ctrl_c() as stop:
            signal.raise_signal(signal.SIGINT)
        assert not stop.asked
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("pressed", [False, True])
def test_what_ctrl_c_did_before_is_there_again_however_a_run_ends(heard, pressed):
    def own(number, frame):
        raise AssertionError("not of this run")

    signal.signal(signal.SIGINT, own)
    with ctrl_c(lambda line: None) as stop:
        assert signal.getsignal(signal.SIGINT) is not own
        if pressed:
            signal.raise_signal(signal.SIGINT)
        assert stop.asked is pressed
    assert signal.getsignal(signal.SIGINT) is own
    with pytest.raises(KeyError), ctrl_c():
        raise KeyError
    assert signal.getsignal(signal.SIGINT) is own
