"""The source files that a source file imports, directly or through other files, and a digest of all these files.

Comments, docstrings and line breaks are not part of the digest: after a change of comments, docstrings or line breaks
no kernel is compiled again. The imports and the digest of each file are kept beside the compiled kernels, under the
file's time of change and size. Reading all sources at every start took a third of the time of the smallest command.
If a file was changed less than `TICK` before it was read, it is read again the next time.
A second change within one tick of the file system's clock would have an equal time.
"""

import ast
import hashlib
import json
import os
import time
from contextlib import suppress
from pathlib import Path

TICK = 2_000_000_000  # ns, the coarsest clock of a file system that is common (FAT)
PACKAGE = "hakobune."  # package prefix of the folders at the root


def imported(file, root, imports=None):
    """Source files below `root` that a source file imports directly, a set of Paths; imports : import statements from
    `parsed`, or None"""
    found = []
    for one in parsed(file.read_bytes())[1] if imports is None else imports:
        if isinstance(one, ast.Import):
            found += [_module(root, alias.name) for alias in one.names]
            continue
        folder, name = file.parents[one.level - 1] if one.level else root, one.module or ""
        # an imported name may itself be a module
        found += [_module(folder, name), *(_module(folder, f"{name}.{alias.name}".lstrip(".")) for alias in one.names)]
    return {source for source in found if source is not None}


def _module(folder, name):
    """The file of a dotted name below a folder, or None if there is none"""
    place = folder.joinpath(*name.removeprefix(PACKAGE).split(".")) if name else folder
    for source in (place.with_suffix(".py"), place / "__init__.py"):
        if source.is_file():
            return source
    return None


def parsed(text):
    """The syntax tree of a source text without docstrings, and the import statements of the source"""
    tree, imports = ast.parse(text), []
    waiting = [tree]
    while waiting:
        one = waiting.pop()
        if isinstance(one, ast.Import | ast.ImportFrom):
            imports.append(one)
        if isinstance(one, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(one, clean=False):
            del one.body[0]
        for part in ("body", "orelse", "handlers", "finalbody"):
            waiting += getattr(one, part, ())
    return ast.dump(tree), imports


class Sources:
    """Source files below a root; kept : file with their imports and digests, which later processes read, or None"""

    def __init__(self, root, kept=None):
        self.root, self.kept = Path(root), kept
        self._now, self._of, self._digests = {}, {}, {}  # dictionaries with a source as key
        try:
            self._before = json.loads(kept.read_text()) if kept else {}
        except (OSError, ValueError):
            self._before = {}

    def of(self, file):
        """The set of paths, as strings, of a source and of all sources that it imports, directly or through other
        sources"""
        source = str(file)
        if source not in self._of:
            found, waiting = set(), [source]
            while waiting:
                one = waiting.pop()
                if one in self._of:
                    found |= self._of[one]
                elif one not in found:
                    found.add(one)
                    waiting += self._known(one)[3]
            self._of[source] = found
        return self._of[source]

    def digest(self, file):
        """Digest, 16 characters, of a source file and of all source files that it imports"""
        if str(file) in self._digests:
            return self._digests[str(file)]
        known, below = len(self._now), len(str(self.root))
        parts = [one[below:] + self._now[one][2] for one in sorted(self.of(file))]
        if self.kept and len(self._now) > known and any(self._before.get(one) != it for one, it in self._now.items()):
            self._keep()
        self._digests[str(file)] = hashlib.sha256("".join(parts).encode()).hexdigest()[:16]
        return self._digests[str(file)]

    def _known(self, source):
        """[time of change or None, size, digest, sources that it imports]"""
        if source not in self._now:
            stat, known = os.stat(source), self._before.get(source)
            same = known and known[:2] == [stat.st_mtime_ns, stat.st_size] and all(map(os.path.isfile, known[3]))
            self._now[source] = known if same else self._read(source, stat)
        return self._now[source]

    def _read(self, source, stat):
        tree, imports = parsed(Path(source).read_bytes())
        settled = time.time_ns() - stat.st_mtime_ns > TICK
        return [
            stat.st_mtime_ns if settled else None,
            stat.st_size,
            hashlib.sha256(tree.encode()).hexdigest(),
            sorted(map(str, imported(Path(source), self.root, imports))),
        ]

    def _keep(self):
        """Store the digests; if the file cannot be written, all sources are read again the next time."""
        self._before |= self._now
        with suppress(OSError):
            put_file(self.kept, json.dumps(self._before).encode())


def put_file(file, data):
    """Write bytes to a file in one operation, safe against other processes that write or read it.  If this raises
    OSError, no file is left."""
    file.parent.mkdir(parents=True, exist_ok=True)
    beside = file.with_suffix(f".{os.getpid()}")
    try:
        beside.write_bytes(data)
        beside.replace(file)
    except OSError:
        beside.unlink(missing_ok=True)
        raise
