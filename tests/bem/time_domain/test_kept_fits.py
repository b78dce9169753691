"""A fit of the memory that is taken from its file is the one that was made, to the bit, and of the same question."""

import numpy as np
import pytest

from hakobune.bem.time_domain import kept_fits
from hakobune.bem.time_domain.kept_fits import NoFit, kept_array, kept_fit
from hakobune.bem.time_domain.passive_fit import Passive

ASKED = np.linspace(0.1, 2.0, 7), np.eye(2) * (1 + 0.3j), 1e-3


@pytest.fixture
def fits(tmp_path, monkeypatch):
    """Function of a question: a `Passive` of random numbers, made or kept, and how many were made"""
    monkeypatch.setenv("HAKOBUNE_CACHE", str(tmp_path))
    monkeypatch.setattr(kept_fits, "cache_folder", lambda *_: tmp_path)
    rng, made = np.random.default_rng(3), []

    def make():
        made.append(Passive(*(rng.normal(size=(3, 2)) for _ in Passive._fields)))
        return made[-1]

    return lambda *asked: (kept_fit(__file__, make, *asked), len(made))


def test_what_is_read_back_is_what_was_made(fits):
    (first, _), (second, made) = fits(*ASKED), fits(*ASKED)
    assert made == 1
    assert all(np.array_equal(one, other) for one, other in zip(first, second, strict=True))


@pytest.mark.parametrize("place", range(len(ASKED)))
def test_another_question_is_fitted_anew(fits, place):
    fits(*ASKED)
    changed = [np.nextafter(x.real, 9) + 1j * x.imag if np.iscomplexobj(x) else np.nextafter(x, 9) for x in ASKED]
    assert fits(*(changed[i] if i == place else x for i, x in enumerate(ASKED)))[1] == 2


def test_a_damaged_file_is_made_again_and_old_ones_go(fits, tmp_path, monkeypatch):
    fits(*ASKED)
    (file,) = (tmp_path / "fits").glob("*.npz")
    for damage in (file.read_bytes()[:100], b"", b"PK"):
        file.write_bytes(damage)
        fits(*ASKED)
    assert fits(*ASKED)[1] == 4
    monkeypatch.setattr(kept_fits, "MOST", 2)
    for tolerance in (1e-2, 2e-2, 3e-2):
        fits(*ASKED[:2], tolerance)
    assert len([*(tmp_path / "fits").iterdir()]) == 2


def test_where_nothing_can_be_kept_fits_are_made(fits, tmp_path):
    (tmp_path / "fits").write_text("")
    assert fits(*ASKED)[1] == 1 and fits(*ASKED)[1] == 2


def test_a_search_in_vain_is_kept_with_the_error_it_came_to(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_fits, "cache_folder", lambda *_: tmp_path)
    tried = []

    def make():
        tried.append(1)
        raise NoFit(0.0123)

    for _ in range(2):
        with pytest.raises(NoFit) as fault:
            kept_fit(__file__, make, *ASKED)
        assert fault.value.best == 0.0123
    assert len(tried) == 1


def test_a_kept_array_is_the_one_that_was_made_and_of_the_same_question(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_fits, "cache_folder", lambda *_: tmp_path)
    made = []

    def make():
        made.append(np.array([0.1 + 0.7j, 1 / 3]) * (1 + len(made)))
        return made[-1]

    first, again = (kept_array(__file__, make, *ASKED, "xy") for _ in range(2))
    assert len(made) == 1 and np.array_equal(first, again) and first.dtype == again.dtype
    other = kept_array(__file__, make, *ASKED, "x")
    assert len(made) == 2 and not np.array_equal(first, other)
    for file in (tmp_path / "fits").glob("*.npz"):
        file.write_bytes(b"PK")
    assert np.array_equal(kept_array(__file__, make, *ASKED, "x"), made[2]) and len(made) == 3


def test_a_search_in_vain_says_how_near_it_came():
    fault = NoFit(np.float32(0.25))
    assert str(fault) == "0.25" and fault.args == (0.25,) and type(fault.best) is float


def test_the_same_bytes_in_another_shape_or_type_are_another_question(fits):
    """Of two rows of three, three of two, and whole numbers with the bytes of zeros"""
    numbers = np.arange(6.0)
    for count, asked in enumerate((numbers, numbers.reshape(2, 3), numbers.reshape(3, 2), np.zeros(2),
                                   np.zeros(2, int)), 1):  # fmt: skip
        assert fits(asked)[1] == count
    assert fits(numbers.reshape(2, 3))[1] == 5
