"""Hooks of MkDocs: pages that are made from the code, and files of the repository outside `docs` that pages show.

- keys.md, keys-KIND.md: the reference of keys, from the typed tables
- theory-CHAPTER.md: what modules say of their equations and sources
- api.md: the public names, which mkdocstrings fills in
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
OUTSIDE = ("CHANGELOG.md", "CONTRIBUTING.md", "tests/bench/results/bench.png", "tests/bench/results/growth.png",
           "tests/bench/results/bench.md")  # fmt: skip
LINK = re.compile(r"\]\((?!https?:)(?:\.\./|docs/)([^)]+)\)")  # to a file of the repository
SAME = (
    "ship",
    "bodies",
    "simulation",
    "side_by_side",
    "bridge",
    "terminal",
    "jetty",
)  # kinds whose keys are those of scene and study
NOT_SEARCHED = ("CHANGELOG.md", "tests/bench/results/bench.md", *(f"keys-{kind}.md" for kind in SAME))
BOOST = {"questions.md": 3.0, "theory": 0.3, "api.md": 0.3, "architecture.md": 0.3, "keys-": 0.7}  # by begin of a name
PACKAGES = ("meshing", "bem", "mooring", "pipelines")


def on_config(config):
    """The version in the title, and the package as it is installed, for mkdocstrings"""
    sys.path[:0] = [str(ROOT), str(ROOT / "docs")]  # MkDocs takes away what a hook adds while it is loaded
    import hakobune

    config.site_name = f"hakobune {hakobune.__version__}"
    place = ROOT / "build" / "api" / "hakobune"
    place.mkdir(parents=True, exist_ok=True)
    parts = {name: ROOT / name for name in PACKAGES} | {"__init__.py": ROOT / "hakobune" / "__init__.py"}
    for name, target in parts.items():
        if not (place / name).is_symlink():
            (place / name).symlink_to(target)
    return config


# what `mkdocs.plugins.event_priority` sets; tests of the pages have no MkDocs.  mkdocstrings looks for build/api later
on_config.mkdocs_priority = 100


def on_files(files, config):
    from mkdocs.structure.files import File

    for name, text in pages().items():
        files.append(File.generated(config, name, content=text))
    for name in OUTSIDE:
        files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
    return files


def on_page_markdown(markdown, page, config, files):
    """Links to files of the repository lead to their copies, links to sources become plain text; ranks of the search"""
    shown, name = {file.src_uri for file in files}, page.file.src_uri
    boost = next((boost for begin, boost in BOOST.items() if name.startswith(begin)), 1.0)
    page.meta["search"] = {"exclude": True} if name in NOT_SEARCHED else {"boost": boost}
    found = re.sub(r"\[([^\]]*)\]\(\.\./([\w/.]+\.(?:py|csv|toml))\)", r"\1", markdown)
    return LINK.sub(lambda link: f"]({link[1]})" if link[1].split("#")[0] in shown else link[0], found)


def pages():
    """{file name: Markdown} of the pages that are made from the code"""
    from theory import CHAPTERS, chapter, contents, slug

    from hakobune.pipelines.keys.kinds import KINDS
    from hakobune.pipelines.keys.reference import reference
    from hakobune.pipelines.keys.shown import as_markdown, kinds_text

    made = {"theory.md": contents(), "api.md": api()}
    made |= {f"theory-{slug(title)}.md": chapter(title) for title in CHAPTERS}
    links = "\n".join(f"- [{name}](keys-{name}.md): {kind.meaning}" for name, kind in KINDS.items())
    made["keys.md"] = (
        "# Keys of all files\n\nEvery key that a file may have: unit, default, meaning, example. `hakobune keys WORD` "
        "searches them in a terminal, and `hakobune keys --schema schemas` writes JSON Schemas for an editor.\n\n"
        f"{links}\n\n"
        f"{kinds_text(False, True)}\n"
    )
    for name, kind in KINDS.items():
        head = (
            f"# Keys: {name}\n\nA file of this kind describes {kind.meaning}. It is read by hakobune {kind.commands}. "
        )
        made[f"keys-{name}.md"] = f"{head}`hakobune new {name}` writes an example.\n\n{as_markdown(reference(name))}\n"
    return made


def api():
    """Markdown of the reference of public names"""
    import hakobune

    modules = {name: f"hakobune.{module}" for name, module in hakobune._PUBLIC.items()}
    modules["Database"] = modules["open_database"] = "hakobune.bem.database.rows"
    classes = [name for name in hakobune.__all__ if name[0].isupper()]
    functions = sorted(name for name in hakobune.__all__ if name[0].islower())
    about = "Each study is a function that returns a `Result`; all quantities are in SI units."
    parts = ["# API", f"The public names of `hakobune`. [As a library](library.md) shows how to use them. {about}"]
    for title, names in (("Functions", functions), ("Classes", classes)):
        parts += [f"## {title}", *(f"::: {modules[name]}.{name}" for name in names)]
    return "\n\n".join(parts) + "\n"
