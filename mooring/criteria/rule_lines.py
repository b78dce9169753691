"""Rule sets of a design, their subjects and quantities, as lines of text."""

import textwrap

from .rules import read_rules
from .verdict import OF_TENSIONS

WIDTH = 110
QUANTITIES = (  # of [[limits]] that load cases give
    *OF_TENSIONS, "surge", "sway", "heave", "roll", "pitch", "yaw", "excursion", "anchor pull x safety / capacity",
    "fender strain / allowable strain", "fender energy / rated energy", "fender reaction / rated reaction",
    "fender strain, total", "fender strain, steady", "design load of a dolphin / fender reaction",
    "line length / (5 depths + tidal range)", "gap between hulls", "hinge force", "hinge moment",
)  # fmt: skip


def rule_lines(words=()):
    """Lines of text: the criteria that have every word in rule, quantity or subject; without words each rule set with
    its subjects, and the quantities of [[limits]]"""
    words = [word.strip("[]").lower() for word in words]
    if words:
        said = [_criterion(one) for one in read_rules() if all(word in _text(one) for word in words)]
        own = [f'[[limits]] of a design: quantity = "{one}"' for one in QUANTITIES if all(w in one for w in words)]
        return list(dict.fromkeys((*own, *said)))
    found = {}
    for one in read_rules():
        found.setdefault(one.rule, {})[one.subject] = None
    rows = [(f'"{rule}": ', ", ".join(f'"{one}"' for one in subjects if one)) for rule, subjects in found.items()]
    wrapped = [textwrap.fill(head + rest, WIDTH, subsequent_indent="    ") for head, rest in rows]
    limits = textwrap.fill("; ".join(f'"{one}"' for one in QUANTITIES), WIDTH - 2)
    return [
        "rule of [[rules]], with its subjects (hakobune keys PIANC shows what a rule set demands):",
        *(textwrap.indent(one, "  ") for one in wrapped),
        "quantity of [[limits]]:",
        textwrap.indent(limits, "  "),
    ]


def _text(one):
    return f"{one.rule} {one.quantity} {one.subject}".lower()


def _criterion(one):
    unit = "" if one.unit in ("", "-") else f" {one.unit}"
    second = "" if one.second is None else f" and {one.second:g}"
    parts = {
        one.subject: True,
        f"state {one.state}": one.state != "any",
        f"lines {one.lines}": one.lines != "any",
        one.analysis: one.analysis != "any",
        "peak to peak": one.statistic == "peak to peak",
        f"at {one.motion_factor:g} times the largest motions": one.motion_factor != 1,
    }
    scope = ", ".join(words for words, said in parts.items() if said and words)
    return f"{one.name}: {one.quantity} {one.sense} {one.limit:.4g}{second}{unit}; {scope}"
