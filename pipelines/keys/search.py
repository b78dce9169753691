"""Search of the keys of all files by words: first in their names, then in their meanings."""

from typing import NamedTuple

from .kinds import KINDS
from .reference import Key, reference
from .words import OTHER_NAMES


class Found(NamedTuple):
    """A key; places : headings of the tables that have the key; kinds : kinds of files that contain these tables"""

    key: Key
    places: tuple[str, ...]
    kinds: tuple[str, ...]


def search(words):
    """[Found, …] of the keys that have every word in name, table or meaning, the best first.

    words : texts in any case; names of other programs and books (Hs, Tp, MBL, KG) find the corresponding keys
    """
    words, found = [word.strip("[]").lower() for word in words], {}
    for kind in KINDS:
        for table in reference(kind):
            for key in table.keys:
                rank = _rank(words, key, table.places)
                if rank is not None:
                    entry = found.setdefault((key.name, key.unit, key.meaning), [rank, key, {}, {}])
                    entry[0] = min(entry[0], rank)
                    entry[2] |= dict.fromkeys(table.places)
                    entry[3] |= {kind: None}
    best = sorted(found.values(), key=lambda entry: entry[0])  # stable: the order of the files within a rank
    return [Found(key, tuple(places), tuple(kinds)) for _, key, places, kinds in best]


def _rank(words, key, places):
    """The sum over the words of 0 (is the name), 1 (in it), 2 (in a heading), 3 (in the meaning); None without one"""
    name, headings, total = key.name.lower(), " ".join(places).lower(), 0
    others, meaning = OTHER_NAMES.get(key.name, "").split(), key.meaning.lower()
    for word in words:
        stands = (word == name or word in others, word in name, word in headings, word in meaning)
        if not any(stands):
            return None
        total += stands.index(True)
    return total
