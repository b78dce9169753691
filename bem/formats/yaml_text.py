"""YAML as dictionaries, lists and scalars; content that is not plain data is refused with its line."""


class YamlFault(ValueError):
    """A text is not YAML of plain data; line : line number from 1, or None if the fault belongs to no single line."""

    def __init__(self, line, text):
        super().__init__(text)
        self.line = line


def parse(text):
    """Dictionaries, lists and scalars of a text, in YAML 1.2 unless the text declares 1.1.  Raises YamlFault."""
    from warnings import catch_warnings, simplefilter

    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    try:
        with catch_warnings():
            simplefilter("ignore")
            return YAML(typ="safe", pure=True).load(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        what = " ".join(part for part in (error.context, error.problem) if part)
        raise YamlFault(mark.line + 1 if mark else None, what.splitlines()[0]) from None
    except RecursionError:
        raise YamlFault(None, "lists and tables are nested too deep") from None
    except (YAMLError, ValueError) as error:
        raise YamlFault(None, str(error).splitlines()[0]) from None
