"""Whether a picture can be made: the kind of file, its folder, a display for a window."""

from __future__ import annotations

import base64
import io
import os
import sys
import tempfile
from pathlib import Path

from bem.database.file import check_place
from meshing.whole_files import write_whole

PLOTS = (".png", ".svg", ".pdf")
VIEWS = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff")


def check_picture(path, kinds):
    """Raise ValueError if no picture can be written there, before any work is done for it."""
    if path.suffix.lower() not in kinds:
        raise ValueError(f"{path} has the suffix {path.suffix!r}; allowed: {', '.join(kinds)}")
    check_place(path)


def save(figure, path, dpi):
    """Write a matplotlib Figure in the format of its suffix.  Raises `meshing.whole_files.NotWritten`."""
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dpi, format=Path(path).suffix[1:].lower() or "png")
    write_whole(path, drawn.getvalue())


def data_address(draw):
    """A picture (PNG) as the address of an `img` that needs no file; draw : writes it to a path"""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.png"
        draw(path)
        return "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode()


def check_display():
    """Raise ValueError where a window would never appear, which VTK passes over."""
    drawn_by_x = sys.platform.startswith("linux")
    if drawn_by_x and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise ValueError("there is no display to open a window on (DISPLAY is not set); give --screenshot out.png")
