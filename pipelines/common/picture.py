"""Whether a picture can be written: format, folder, a display for a window."""

import base64
import io
import os
import sys
import tempfile
from pathlib import Path

from hakobune.meshing.whole_files import write_whole

PLOTS = (".png", ".svg", ".pdf")
FIRST_OF_OTHERS = "\u2e80"  # first of the Chinese, Japanese and Korean letters, which matplotlib's own font lacks
BOXES = "Last Resort"  # a font of matplotlib with a box for every letter
VIEWS = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff")


def check_picture(path, kinds):
    """Raise ValueError if no picture can be written to the path; called before the computation; None for no picture."""
    if path is None:
        return
    from hakobune.bem.database.file import check_place

    if path.suffix.lower() not in kinds:
        raise ValueError(f"{path} has the suffix {path.suffix!r}; allowed: {', '.join(kinds)}")
    check_place(path)


def save(figure, path, dpi):
    """Write a matplotlib Figure in the format of its suffix.  Raises `meshing.whole_files.NotWritten`.

    Letters missing in matplotlib's own font, such as those of Japanese names, come from an installed font that has
    them; without one, a warning is given.
    """
    _give_letters(figure)
    drawn, kind = io.BytesIO(), Path(path).suffix[1:].lower() or "png"
    packed = {"pil_kwargs": {"compress_level": 1}} if kind == "png" else {}  # a tenth larger in a third of the time
    figure.savefig(drawn, dpi=dpi, format=kind, **packed)
    write_whole(path, drawn.getvalue())


def draw_streams(axes, towards):
    """Draw an arrow for each of {name: rad to which it travels}, one below the other, left of the matplotlib axes"""
    import numpy as np

    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    size = 0.06 * max(right - left, high - low)
    for i, (name, angle) in enumerate(towards.items()):
        to = size * np.array([np.cos(angle), np.sin(angle)])
        middle = np.array([left - 1.5 * size, high - (1 + 2.5 * i) * size])
        axes.annotate("", middle + to, middle - to, arrowprops={"arrowstyle": "-|>", "color": f"C{i}", "lw": 2})
        axes.plot([], [], color=f"C{i}", lw=2, label=name)
    if towards:
        axes.set_xlim(left - 3 * size, right)
        axes.set_ylim(min(low, high - 2.5 * len(towards) * size), high)


def font_file(text):
    """Path of an installed font that has the letters of a text, for VTK, whose own font has only Latin letters; None if
    its own font suffices"""
    if text.isascii():
        return None
    found = font_with({letter for letter in text if not letter.isascii() and letter.isprintable()})
    return None if found is None else found.fname


def _give_letters(figure):
    """Add a fallback font to every text with letters that its font lacks"""
    texts = [text for text in _texts(figure) if not text.get_text().isascii()]
    strange = {letter for text in texts for letter in text.get_text() if letter > FIRST_OF_OTHERS}
    if not strange:
        return
    font = font_with(strange)
    if font is None:
        name = next(text.get_text() for text in texts if set(text.get_text()) & strange)
        print(
            f"warning: no installed font has the letters of {name!r}, which stay empty in the picture; install "
            "one, such as fonts-noto-cjk on Debian or Ubuntu",
            file=sys.stderr,
        )
        return
    for text in texts:
        text.set_fontfamily([*text.get_fontfamily(), font.name])


def _texts(artist):
    """Every visible matplotlib Text of a Figure or a part of it"""
    from matplotlib.text import Text

    if isinstance(artist, Text):
        yield artist
    for child in _parts(artist) if artist.get_visible() else ():
        yield from _texts(child)


def _parts(artist):
    """Parts of an artist that may contain letters: axes create their ticks on request, and numbers need none"""
    from matplotlib.axis import Axis
    from matplotlib.ticker import LogFormatter, NullFormatter, ScalarFormatter

    numbers = ScalarFormatter, LogFormatter, NullFormatter
    if isinstance(artist, Axis) and all(
        isinstance(form, numbers) for form in (artist.get_major_formatter(), artist.get_minor_formatter())
    ):
        return artist.label, artist.offsetText
    return artist.get_children()


def font_with(letters):
    """The first installed font that has these letters, as matplotlib's FontEntry, or None"""
    from matplotlib.font_manager import fontManager, get_font

    codes = {ord(letter) for letter in letters}
    for entry in sorted(fontManager.ttflist, key=lambda entry: (entry.weight != 400, entry.name)):
        if not entry.name.startswith(BOXES) and codes <= get_font(entry.fname).get_charmap().keys():
            return entry
    return None


def data_address(draw):
    """A picture (PNG) as a data address for an `img` without a file; draw : writes it to a path"""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.png"
        draw(path)
        return "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode()


def check_display():
    """Raise ValueError if there is no display for a window; VTK does not report this."""
    drawn_by_x = sys.platform.startswith("linux")
    if drawn_by_x and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise ValueError(
            "there is no display to open a window on (DISPLAY is not set); give --plot out.png or --page out.html"
        )
