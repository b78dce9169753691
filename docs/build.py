"""`make docs`: the guide as static pages in docs/html, and with it the reference of all keys and the page of theory.

Pages are Markdown of this folder; links between them keep working, in the browser and in a repository viewer.
"""

from __future__ import annotations

import html
import re
import shutil
import sys
from pathlib import Path

DOCS = Path(__file__).parent
sys.path[:0] = [str(DOCS.parent), str(DOCS)]
NAMED = (  # on every page
    "first_hour", "tasks", "commands", "keys", "conventions", "formats", "methods", "theory", "results", "library",
    "accuracy", "architecture",
)  # fmt: skip
PICTURE = re.compile(r"!\[[^\]]*\]\(([^)]+)\)")
STYLE = """body{font:16px/1.5 sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222}
nav{border-bottom:1px solid #ccc;padding-bottom:.5rem;margin-bottom:1.5rem}nav a{margin-right:1rem;white-space:nowrap}
pre,code{background:#f4f4f4;font-size:.92em}pre{padding:.7rem;overflow:auto}img{max-width:100%}
table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:.2rem .5rem;text-align:left;vertical-align:top}"""


def pages():
    """{name: Markdown} of the guide: those that lie here, and one of keys for every kind of file"""
    from theory import theory

    from hakobune.pipelines.keys.kinds import KINDS
    from hakobune.pipelines.keys.reference import reference
    from hakobune.pipelines.keys.shown import as_markdown, kinds_text

    made = {path.stem: path.read_text(encoding="utf-8") for path in sorted(DOCS.glob("*.md"))}
    links = "\n".join(f"- [{name}](keys-{name}.md): {kind.meaning}" for name, kind in KINDS.items())
    made["theory"] = theory()
    made["keys"] = f"# Keys of all files\n\n{kinds_text(False, True)}\n\n{links}\n"
    for name, kind in KINDS.items():
        head = f"# Keys: {name}, {kind.meaning}\n\nRead by hakobune {kind.commands}; `hakobune new {name}` writes one."
        made[f"keys-{name}"] = f"{head}\n\n{as_markdown(reference(name))}\n"
    return made


def rendered(text, names):
    """HTML of a page; its links to pages of these names lead to theirs"""
    from markdown_it import MarkdownIt

    body = MarkdownIt("commonmark", {"html": False}).enable("table").render(text)
    body = re.sub(r'href="(?:docs/)?([\w-]+)\.md', lambda m: f'href="{m[1]}.html' if m[1] in names else m[0], body)
    body = re.sub(r'src="[^"]*?([^"/]+)"', r'src="\1"', body)
    title = html.escape(re.sub(r"[#`*]", "", text.strip().splitlines()[0]).strip())
    nav = " ".join(f'<a href="{name}.html">{name.replace("_", " ")}</a>' for name in NAMED if name in names)
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
        f'<nav><a href="index.html"><b>hakobune</b></a> {nav}</nav>{body}</html>\n'
    )


def build(place):
    """Write all pages and pictures into a folder.  Returns the paths of the pages."""
    place = Path(place)
    place.mkdir(parents=True, exist_ok=True)
    made = pages()
    for name, text in made.items():
        (place / f"{name}.html").write_text(rendered(text, list(made)), encoding="utf-8")
    for name in sorted({name for text in made.values() for name in PICTURE.findall(text)}):
        shutil.copy(DOCS / name, place)
    shutil.copytree(DOCS / "notebooks", place / "notebooks", dirs_exist_ok=True)
    return [place / f"{name}.html" for name in made]


if __name__ == "__main__":
    written = build(sys.argv[1] if len(sys.argv) > 1 else DOCS / "html")
    print(f"{len(written)} pages; open {written[0].parent / 'index.html'}")
