"""docs/architecture.md names only what is there."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")


def test_every_path_on_the_page_exists():
    roots = [ROOT, *(ROOT / room for room in ("bem", "mooring", "mooring/lines", "pipelines"))]
    paths = {path.split("::")[0] for path in re.findall(r"`([a-z_]+/[\w/]*(?:\.py)?(?:::\w+)?[\w.]*)`", PAGE)}
    assert len(paths) > 40
    assert not [path for path in paths if not any((root / path).exists() for root in roots)]


def test_every_folder_of_modules_is_on_the_page_which_is_short():
    for package in ("bem", "mooring", "pipelines"):
        for folder in {file.parent for file in (ROOT / package).rglob("*.py")}:
            assert folder.name in PAGE, folder
    assert len(PAGE.splitlines()) <= 150
