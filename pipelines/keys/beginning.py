"""A file to begin with: the shipped example of a kind, with each key explained at its first use."""

import re
import shutil
import tomllib
from pathlib import Path

from hakobune.bem.database.file import check_place

from .kinds import KINDS, SCENES, kind_named
from .reference import reference

LONGEST = 110  # characters of a line


def write(name, file):
    """Write the file of a kind and the files that it needs; existing files are not replaced.

    returns : written paths, and the commands that run the file.  Raises ValueError.
    """
    kind = kind_named(name)
    file, example = Path(file), SCENES / kind.example
    if file.suffix != ".toml":
        raise ValueError(f"{file} has the suffix {file.suffix!r}; allowed: .toml")
    beside = {path: file.parent / path.name for path in needed(example, kind.beside)}
    same = [place for source, place in beside.items() if place.is_file() and place.read_bytes() == source.read_bytes()]
    taken = [path for path in (file, *beside.values()) if path.exists() and path not in same]
    if taken:
        raise ValueError(f"{taken[0]} is there already and is not replaced; give another name or folder")
    check_place(file)
    file.write_text(commented(name).replace(example.name, file.name), encoding="utf-8")
    for source, place in beside.items():
        shutil.copyfile(source, place)
    folder = "" if file.parent == Path() else f"{file.parent}/"
    steps = [step.replace("FILE", str(file)).replace(" series_box", f" {folder}series_box") for step in kind.steps]
    return [file, *beside.values()], steps


def needed(example, beside=()):
    """Files of `pipelines/scenes` named in an example, the files that these files name, and `beside`"""
    found, left = [], [SCENES / name for name in beside] + [example]
    while left:
        path = left.pop()
        if path not in found:
            found.append(path)
            if path.suffix == ".toml":
                left += [SCENES / text for text in _texts(tomllib.loads(path.read_text(encoding="utf-8")))]
    return [path for path in found if path != example]


def commented(name):
    """Text of the example of a kind with a comment at each key that has none yet"""
    told = {}
    for table in reference(name):
        for place in table.places:
            path = place.strip("[]")
            told |= {(path, key.name): _remark(key) for key in table.keys}
    own = next(kind for kind in (name, *KINDS) if kind in KINDS and KINDS[kind] == kind_named(name))
    lines, path = [f"# hakobune keys {own}   explains every key, including those that are not in this file"], ""
    for line in (SCENES / kind_named(name).example).read_text(encoding="utf-8").splitlines():
        if head := re.match(r"\[+([\w.-]+)\]+", line):
            path = _place(head[1], told)
        key = re.match(r"(\w+)\s*=", line)
        remark = told.pop((path, key[1]), "") if key else ""
        if not remark or " #" in line:
            lines.append(line)
        elif line.count("[") == line.count("]") and len(line) + len(remark) + 4 <= LONGEST:
            lines.append(f"{line}  # {remark}")
        else:
            lines += [f"# {key[1]}: {remark}", line]
    return "\n".join(lines) + "\n"


def _remark(key):
    return ", ".join(part for part in (key.unit, key.meaning) if part)


def _place(head, told):
    """The path of a heading as in the reference, with NAME for names chosen by the user"""
    if any(path == head for path, _ in told):
        return head
    *before, _ = head.split(".")
    return ".".join([*before, "NAME"])


def _texts(value):
    """Texts in nested tables that name a file of `pipelines/scenes`"""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [text for inner in value for text in _texts(inner)]
    known = isinstance(value, str) and re.fullmatch(r"[\w.-]+\.(toml|csv)", value) and (SCENES / value).is_file()
    return [value] if known else []
