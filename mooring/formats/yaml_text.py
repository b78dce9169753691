"""YAML 1.2 as dictionaries, lists and scalars, in which 1e6 is a number; what is not plain data is refused by line."""

from __future__ import annotations

from .fault import fault


def parse_yaml(text, path="YAML file"):
    """Dictionaries, lists and scalars of a text; `path` is what errors call it.  Raises FormatError with the line."""
    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    try:
        return YAML(typ="safe", pure=True).load(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        what = " ".join(part for part in (error.context, error.problem) if part)
        raise fault(path, mark.line + 1 if mark else None, None, what.splitlines()[0]) from None
    except RecursionError:
        raise fault(path, None, None, "lists and tables are nested too deep") from None
    except (YAMLError, ValueError) as error:
        raise fault(path, None, None, str(error).splitlines()[0]) from None
