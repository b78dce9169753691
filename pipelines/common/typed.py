"""Tables of TOML as typed values, and a one-line message on the first fault in them."""

import difflib
import re
import tomllib
import typing

import msgspec

from hakobune.meshing.text_files import read_text

from ..keys.words import OTHER_NAMES

Typed = typing.TypeVar("Typed")
NESTED = dict | list | tuple
ALIKE = 0.75  # similarity of letters above which a key counts as misspelt
LARGEST = 8  # MB, which take some seconds
WORDS = {
    "float": "a number",
    "int": "a whole number",
    "str": "text",
    "bool": "true or false",
    "array": "a list",
    "object": "a table",
    "null": "nothing",
}


def read_toml(path, what, error):
    """Nested dictionaries of a TOML file, and the text of the file.

    what : words for messages, such as "a study"; error : class raised with one line
    """
    text = read_text(path, error, largest=LARGEST)
    try:
        return tomllib.loads(text), text
    except RecursionError:
        raise error(f"{path} is not {what}: its lists are nested too deeply") from None
    except tomllib.TOMLDecodeError as fault:
        raise error(f"{path} is not TOML: {fault}") from None


def typed(raw: dict[str, typing.Any], kind: type[Typed], error: type[ValueError]) -> Typed:
    """`raw` as a value of the msgspec.Struct `kind`.

    raw : nested dictionaries read from TOML; error : class raised with key, value and allowed values
    """
    try:
        return msgspec.convert(raw, kind)
    except msgspec.ValidationError as fault:
        raise error(of_another(raw, kind) or _line(str(fault), raw, kind)) from None


def to_toml(study):
    """TOML that reads back as the same typed study or scene; keys that are None are left out"""
    import tomli_w

    return tomli_w.dumps(without_none(msgspec.to_builtins(study)))


def without_none(value):
    """Nested dictionaries and lists without None, which TOML cannot represent"""
    if isinstance(value, dict):
        return {key: without_none(one) for key, one in value.items() if one is not None}
    if isinstance(value, list | tuple):
        return [without_none(one) if isinstance(one, NESTED) else one for one in value]
    return value


def differing(table):
    """{key: value} of a msgspec.Struct for all values that differ from their defaults, also in nested tables.

    A key added by a later version therefore appears only in files that give it.
    """
    return {
        field.encode_name: _plain(value)
        for field in msgspec.structs.fields(table)
        if (value := getattr(table, field.name)) != field.default
        and (field.default_factory is msgspec.NODEFAULT or value != field.default_factory())
    }


def _plain(value):
    if isinstance(value, msgspec.Struct):
        return differing(value)
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    return [_plain(part) for part in value] if isinstance(value, list | tuple) else value


def of_another(raw, kind):
    """Commands that could read the file as one of a different kind without a fault; "" if there are none"""
    known = {field.encode_name for field in msgspec.structs.fields(kind)}
    strange = [key for key in raw if key not in known]
    if not strange:
        return ""
    from ..keys.kinds import that_read

    commands = that_read(raw)
    return f"{strange[0]} belongs to another command: this file is read by {' or '.join(commands)}" if commands else ""


def _line(message, raw, kind):
    what, _, where = message.partition(" - at ")
    path = where.strip("`").removeprefix("$").removeprefix(".")
    named = re.match(r"Object (contains unknown|missing required) field `(.+)`", what)
    if named and named[1] == "contains unknown":
        return _of_unknown(list(_unknown(raw, kind)))
    if named:
        keys = [field.encode_name for field in msgspec.structs.fields(_table(kind, path))]
        return f"{path + '.' if path else ''}{named[2]} is missing; {_allowed(keys)}"
    expected, _, got = what.removeprefix("Expected ").partition(", got ")
    expected = " or ".join(_words(part) for part in expected.split(" | ") if "null" not in part)
    return f"{path or 'the file'} is {_value(raw, path, got)}; allowed: {expected}"


def _of_unknown(rows):
    """Line on all unknown keys of a file; the allowed ones are those beside the first"""
    (first, key, keys), *others = rows
    more = "; ".join(name + _meant(other, known) for name, other, known in others)
    return f"{first} is unknown{_meant(key, keys)}; {_allowed(keys)}" + (f"; also unknown: {more}" if more else "")


def _allowed(keys):
    return f"allowed: {', '.join(keys)} (hakobune keys explains them)"


def _unknown(value, hint, path=""):
    """(path with key, key, allowed keys) of every unknown key, in the order of the file"""
    parts, is_table = typing.get_args(hint), isinstance(value, dict)
    if isinstance(value, list) and typing.get_origin(hint) in (list, tuple):
        for i, one in enumerate(value):
            yield from _unknown(one, parts[0], f"{path}[{i}]")
    elif is_table and isinstance(hint, type) and issubclass(hint, msgspec.Struct):
        hints = typing.get_type_hints(hint)
        known = {field.encode_name: hints[field.name] for field in msgspec.structs.fields(hint)}
        for key, one in value.items():
            name = f"{path}.{key}" if path else key
            if key in known:
                yield from _unknown(one, known[key], name)
            else:
                yield name, key, list(known)
    elif is_table and typing.get_origin(hint) is dict:
        for key, one in value.items():
            yield from _unknown(one, parts[1], f"{path}.{key}")
    elif isinstance(value, NESTED):
        for part in parts:  # of a union
            yield from _unknown(value, part, path)


def _meant(key, keys):
    """Text ", {key} may be meant" for a key with another name or a misprint; "" if none is similar"""
    other = [name for name, others in OTHER_NAMES.items() if name in keys and key.lower() in others.split()]
    found = other or difflib.get_close_matches(key.lower(), keys, 1, ALIKE)
    return f", {found[0]} may be meant" if found else ""


def _words(text):
    """`array` of length 3 → a list of length 3"""
    return re.sub(r"\w+", lambda word: WORDS.get(word[0], word[0]), text.replace("`", ""))


def _value(raw, path, got):
    """The value at the path; where the path contains names chosen by the user, only the type of the value."""
    try:
        for part in re.findall(r"[^.\[\]]+", path):
            raw = raw[int(part)] if isinstance(raw, list) else raw[part]
    except (LookupError, ValueError, TypeError):
        return _words(got)
    return repr(raw)


def _table(kind, path):
    """The Struct that describes the table at a path"""
    for name in re.findall(r"\w+", re.sub(r"\[.*?\]", "", path)):
        kind = next(_tables(typing.get_type_hints(kind)[name]))
    return kind


def _tables(kind):
    if isinstance(kind, type) and issubclass(kind, msgspec.Struct):
        yield kind
    for part in typing.get_args(kind):
        yield from _tables(part)
