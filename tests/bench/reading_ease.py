"""How easy the guide and the messages are to read: Flesch's reading ease and words a sentence.

    python tests/bench/reading_ease.py [FOLDER OF ANOTHER GUIDE …]

    ease = 206.835 − 1.015 words/sentence − 84.6 syllables/word      Flesch (1948), J. Applied Psychology 32, 221

60 to 70 is plain English, 30 to 50 the text of a technical manual.  Code, tables, headings, links and formulas are left
out, in Markdown and in reStructuredText alike.  Messages are the texts of exceptions and of findings in the product.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDERS = ("meshing", "bem", "mooring", "pipelines")
SAID = ("Error", "fails", "warning", "note", "Finding", "print")  # names of calls whose texts are read by a user


def prose(text):
    """Sentences of a page of Markdown or reStructuredText"""
    text = re.sub(r"^```.*?^```|^~~~.*?^~~~", "\n", text, flags=re.S | re.M)
    text = re.sub(r"^\.\. [\w-]+::.*\n(?:[ \t]+.*\n|\n(?=[ \t]))*", "\n", text, flags=re.M)  # directives
    text = re.sub(r"^(?: {4}|\t|\||\+[-=]|#|=|~|-{3}|\.\. ).*$", "\n", text, flags=re.M)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)|`([^`<]*)<[^>]*>`_+", r"\1\2", text)
    text = re.sub(r":\w+:`~?([^`]*)`", r"\1", text)
    text = re.sub(r"`+[^`]*`+_*|<[^>]*>|\$[^$]*\$", "X", text)
    text = re.sub(r"^[ \t]*(?:[-*+]|\d+\.)\s+", "\n\n", text, flags=re.M)  # each item is a sentence
    return [one for block in re.split(r"\n\s*\n", text) for one in sentences(" ".join(block.split()))]


def sentences(text):
    found = [part.strip() for part in re.split(r"(?<=[.!?:;])\s+(?=[A-Z*(X])", text)]
    return [one for one in found if len(words(one)) > 3]


def words(sentence):
    return [w for w in re.findall(r"[A-Za-z][A-Za-z'’-]*", sentence) if len(w) > 1 or w in ("a", "A", "I")]


def syllables(word):
    """Groups of vowels, without a silent e"""
    word = re.sub(r"[^a-z]", "", word.lower())
    return max(1, len(re.findall(r"[aeiouy]+", re.sub(r"(?<=[^aeiouyl])e$|(?<=[^dt])ed$|(?<=[^scz])es$", "", word))))


def ease(found):
    """(Flesch's reading ease, words a sentence, share of sentences of more than 30 words) of sentences"""
    lengths = [len(words(one)) for one in found]
    total = sum(lengths)
    spoken = sum(syllables(word) for one in found for word in words(one))
    per = total / len(found)
    return 206.835 - 1.015 * per - 84.6 * spoken / total, per, sum(n > 30 for n in lengths) / len(found)


def messages(root=ROOT):
    """Sentences of exceptions and findings in the product, values replaced by X"""
    found = []
    for folder in FOLDERS:
        for file in sorted((Path(root) / folder).rglob("*.py")):
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call) and name(node.func).endswith(SAID):
                    texts = [text_of(argument) for argument in node.args]
                    found += [one for text in texts for part in text.split(";") for one in sentences(part)]
    return found


def name(node):
    return getattr(node, "id", getattr(node, "attr", ""))


def text_of(node):
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "X" for part in node.values)
    return ""


def pages(folder):
    """Sentences of all pages below a folder"""
    files = sorted(path for ending in ("*.md", "*.rst") for path in Path(folder).rglob(ending))
    return [one for file in files for one in prose(file.read_text(encoding="utf-8", errors="replace"))]


def main():
    guide = [*prose((ROOT / "README.md").read_text(encoding="utf-8")), *pages(ROOT / "docs")]
    rows = [("guide", guide), ("messages", messages()), *((folder, pages(folder)) for folder in sys.argv[1:])]
    print(f"{'text':<40} {'sentences':>9} {'ease':>6} {'words':>6} {'> 30 words':>10}")
    for title, found in rows:
        score, per, long = ease(found)
        print(f"{title[-40:]:<40} {len(found):>9} {score:>6.1f} {per:>6.1f} {long:>10.0%}")


if __name__ == "__main__":
    main()
