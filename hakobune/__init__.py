"""From a floating body's dimensions to the tension in its last mooring line.

The packages `hakobune.meshing`, `hakobune.bem`, `hakobune.mooring` and `hakobune.pipelines` are installed below this
one.  In a checkout they are folders beside it.
"""

from pathlib import Path

_CHECKOUT = Path(__file__).parents[1]
if (_CHECKOUT / "pyproject.toml").is_file():
    __path__.append(str(_CHECKOUT))
