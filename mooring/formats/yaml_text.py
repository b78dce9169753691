"""YAML as dictionaries, lists and scalars, with the errors of this package."""

from hakobune.bem.formats.yaml_text import YamlFault, parse

from .fault import fault


def parse_yaml(text, path="YAML file"):
    """Dictionaries, lists and scalars of a text; `path` is its name in errors.  Raises FormatError with the line."""
    try:
        return parse(text)
    except YamlFault as error:
        raise fault(path, error.line, None, str(error)) from None
