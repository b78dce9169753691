"""Frequencies stored together."""

from contextlib import suppress

import h5py
import numpy as np
import pytest
from test_database import HEADINGS, NAMES, OMEGAS, header, result

from hakobune.bem.database import Storing, append, create, pending, storing, writing
from hakobune.bem.database.widening import at_angles

MORE = (0.2, *OMEGAS, 1.6)


def contents(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
    return found


@pytest.mark.parametrize("places", [(0, 1, 2, 3, 4), (4, 0, 1), (3, 1)])
@pytest.mark.parametrize("headings", [HEADINGS, HEADINGS[1:]])
def test_frequencies_stored_together_are_those_stored_one_by_one_to_the_last_bit(places, headings, tmp_path):
    for name in ("together.h5", "alone.h5"):
        create(tmp_path / name, header(), MORE, HEADINGS, NAMES)
    rows = [(MORE[i], headings, result(MORE[i], headings, NAMES)) for i in places]
    with writing(tmp_path / "together.h5") as file:
        waiting = Storing(file)
        for row in rows:
            waiting.add(*row)
        waiting.store()
    with writing(tmp_path / "alone.h5") as file:
        for row in rows:
            append(file, *row)
    together, alone = contents(tmp_path / "together.h5"), contents(tmp_path / "alone.h5")
    assert set(together) == set(alone)
    for name in together:
        np.testing.assert_array_equal(together[name], alone[name], err_msg=name)


@pytest.mark.parametrize("writes", range(0, 16, 3))
def test_a_run_killed_while_frequencies_are_stored_together_marks_none_whose_numbers_are_missing(
    writes, tmp_path, monkeypatch
):
    class Killed(BaseException):
        pass

    path, put, left = tmp_path / "box.h5", storing.put, [writes]
    create(path, header(), OMEGAS, HEADINGS, NAMES)

    def dying(*arguments):
        left[0] -= 1
        if left[0] < 0:
            raise Killed
        put(*arguments)

    def run():
        with writing(path) as file:
            waiting = Storing(file)
            for row in pending(file).rows:
                waiting.add(row.omega, row.headings, result(row.omega, row.headings, row.want))
            waiting.store()

    with monkeypatch.context() as patched:
        patched.setattr(storing, "put", dying)
        with suppress(Killed):
            run()
    run()
    assert not pending(path).rows


def test_kochin_functions_are_the_same_at_more_angles():
    """A trigonometric polynomial of degree 20, known at 60 angles, and its own values at 82"""
    order = np.arange(-20, 21)
    shares = np.exp(1j * order**2) / (1 + order**2)
    few, many = (np.exp(1j * np.outer(2 * np.pi * np.arange(n) / n, order)) @ shares for n in (60, 82))
    assert at_angles(np.stack([few, 2 * few]), 82) == pytest.approx(np.stack([many, 2 * many]), abs=1e-12)


@pytest.mark.parametrize("count, more", [(7, 12), (7, 9), (8, 12), (8, 11), (5, 5)])
def test_series_of_an_odd_and_of_an_even_number_of_angles_are_the_same_at_more(count, more):
    """Harmonics below half of them, from −3 to 3 of 7 and of 8"""
    highest = (count - 1) // 2
    order = np.arange(-highest, highest + 1)
    series = np.arange(1, len(order) + 1) * (1 - 0.5j)

    def H(n):
        return np.exp(1j * np.multiply.outer(2 * np.pi * np.arange(n) / n, order)) @ series

    found = at_angles(np.stack([H(count), 2 * H(count)]), more)
    assert found.shape == (2, more)
    assert found[0] == pytest.approx(H(more)) and found[1] == pytest.approx(2 * H(more))


def test_numbers_reach_the_disk_before_their_marks_and_motions_before_what_follows_from_them(tmp_path, monkeypatch):
    """At each flush: data without marks; marks of motions; all marks, and the frequency is solved"""
    path, seen, names = tmp_path / "box.h5", [], NAMES[:-1]
    create(path, header(), OMEGAS, HEADINGS, names)
    kept = h5py.File.flush

    def flush(file):
        marks = {name: bool(np.any(file["stored"][name][1] != 0)) for name in names}
        data = {name: bool(np.all(np.isfinite(file[name][1]))) for name in names}
        seen.append((data, marks, bool(file["solved"][1]), bool(np.isfinite(file["checks/energy"][1]))))
        kept(file)

    with writing(path) as file, monkeypatch.context() as patched:
        patched.setattr(h5py.File, "flush", flush)
        append(file, OMEGAS[1], HEADINGS, result(OMEGAS[1], HEADINGS, names) | {"checks": {"energy": 1e-3}})
    motions = {name for name in names if name in ("rao", "drift_force", "body_drift_force")}
    assert motions and len(seen) == 3
    for data, _, _, checked in seen:
        assert all(data.values()) and checked
    for (_, marks, solved, _), told in zip(seen, (set(), motions, set(names)), strict=True):
        assert {name for name, there in marks.items() if there} == told and solved is (told == set(names))


def test_a_limit_reaches_the_disk_before_its_mark(tmp_path, monkeypatch):
    path, seen, kept = tmp_path / "box.h5", [], h5py.File.flush
    create(path, header(), OMEGAS, HEADINGS, NAMES)

    def flush(file):
        seen.append((file["added_mass_infinity"][0, 0], bool(np.any(file["stored/added_mass_infinity"][()] != 0))))
        kept(file)

    with writing(path) as file, monkeypatch.context() as patched:
        patched.setattr(h5py.File, "flush", flush)
        storing.append_limit(file, "added_mass_infinity", np.full((6, 6), 3.0))
    assert seen == [(3.0, False), (3.0, True)]
