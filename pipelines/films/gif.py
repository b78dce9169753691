"""A film as a file, frame by frame, and its common parts."""

import io

from hakobune.meshing.whole_files import write_whole

from ..common.bounds import Pace
from ..common.outputs import check_output

ENDINGS = (".gif",)
FRAMES_A_SECOND = 10
SIZE = 800, 500
MOST = 2000  # frames
SKY, BED, SEA, HULL = "white", "#d8c9a0", "#4f8fc0", "#b04030"


def check_film(output, inputs):
    """Raise ValueError unless a film can be written to `output` without the loss of another file."""
    check_output(output, "a film", _is_film, ENDINGS, inputs)


def check_count(frames):
    """Raise ValueError for too few or too many frames."""
    if not 2 <= frames <= MOST:
        raise ValueError(f"the film has {frames} frames; allowed: 2 to {MOST}; give another --length or --step")


def new_plotter():
    """A pyvista Plotter without a window"""
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # a machine without display is no fault here
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    plotter.set_background(SKY)
    return plotter


def write_film(output, frames, count):
    """Write pictures (height, width, 3) as a film; the frame number is printed if writing takes long."""
    from PIL import Image

    pace = Pace(f"{count} frames take", count, "give a shorter --length or a longer --step")
    first, *others = [
        Image.fromarray(frame).convert("P", palette=Image.Palette.ADAPTIVE) for frame in _counted(frames, pace)
    ]
    drawn = io.BytesIO()
    first.save(drawn, "GIF", save_all=True, append_images=others, duration=1000 // FRAMES_A_SECOND, loop=0)
    write_whole(output, drawn.getvalue())


def _counted(frames, pace):
    for frame in frames:
        pace.step()
        yield frame


def _is_film(path):
    return path.read_bytes()[:6] in (b"GIF89a", b"GIF87a")
