"""From a floating body's dimensions to the tension in its last mooring line.

    import hakobune
    hakobune.solve("box.toml", "box.h5")
    result = hakobune.moor("study.toml", "box.h5")
    result["tension.largest"], result.fails

Each study is a function from its input (a path, a dictionary, or the typed study) to a result
(`hakobune.pipelines.results.result.Result`).  The packages `hakobune.meshing`, `hakobune.bem`, `hakobune.mooring` and
`hakobune.pipelines` are installed below this one.  In a checkout they are folders beside it.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hakobune.bem.database import Database as Database
    from hakobune.bem.database import open_database as open_database
    from hakobune.pipelines.berth.result import berth as berth
    from hakobune.pipelines.breakwater.result import breakwater as breakwater
    from hakobune.pipelines.damping.result import damping as damping
    from hakobune.pipelines.design.result import design as design
    from hakobune.pipelines.downtime.result import downtime as downtime
    from hakobune.pipelines.earthquake.result import earthquake as earthquake
    from hakobune.pipelines.fender.result import fender as fender
    from hakobune.pipelines.line_dynamics.result import line_dynamics as line_dynamics
    from hakobune.pipelines.lines.line_result import line as line
    from hakobune.pipelines.lines.lines_result import lines as lines
    from hakobune.pipelines.members.result import members as members
    from hakobune.pipelines.moor.result import moor as moor
    from hakobune.pipelines.passing.result import passing as passing
    from hakobune.pipelines.qtf.result import qtf as qtf
    from hakobune.pipelines.reading import read as read
    from hakobune.pipelines.response.result import response as response
    from hakobune.pipelines.results.quantity import Quantity as Quantity
    from hakobune.pipelines.results.result import Result as Result
    from hakobune.pipelines.sea.result import sea as sea
    from hakobune.pipelines.sections.result import sections as sections
    from hakobune.pipelines.simulate.result import simulate as simulate
    from hakobune.pipelines.single_point.result import single_point as single_point
    from hakobune.pipelines.site.result import site as site
    from hakobune.pipelines.solve.result import solve as solve
    from hakobune.pipelines.sweep.result import sweep as sweep
    from hakobune.pipelines.waves.result import waves as waves

    __version__: str

if not (Path(__file__).parent / "bem").is_dir():  # in a checkout
    __path__.append(str(Path(__file__).parents[1]))

from hakobune.pipelines.results.studies import MODULES

_PUBLIC = {  # name: module that has it
    "Database": "bem.database",
    "Quantity": "pipelines.results.quantity",
    "Result": "pipelines.results.result",
    "open_database": "bem.database",
    "read": "pipelines.reading",
} | MODULES
__all__ = [*_PUBLIC]  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name):
    """A public name, imported when it is first asked for, so that `import hakobune` loads nothing else"""
    if name == "__version__":
        return import_module("hakobune.bem").__version__
    if name not in _PUBLIC:
        raise AttributeError(f"hakobune has no {name!r}; it has {', '.join(_PUBLIC)}")
    return getattr(import_module(f"hakobune.{_PUBLIC[name]}"), name)


def __dir__():
    return [*_PUBLIC, "__version__"]
