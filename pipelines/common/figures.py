"""matplotlib's Figure, without the texts of help that matplotlib writes for each of its classes as it loads: 0.1 s."""

from matplotlib import artist

artist.kwdoc = lambda _: ""

from matplotlib.figure import Figure  # noqa: E402 - after what it calls while it loads

__all__ = ["Figure"]
