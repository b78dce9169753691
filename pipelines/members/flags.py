"""The flags of `hakobune members`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def members(
    study: Annotated[Path, Parameter(help="members, water, wave, current, wind (TOML)")],
    /,
    *,
    plot: Annotated[Path | None, Parameter(help="forces over the wave: .png, .svg or .pdf")] = None,
):
    """Compute water and wind loads on slender members, piles and frames over a regular wave.

    It uses Morison's formula and includes marine growth.  hakobune members members_dolphin.toml --plot forces.png
    """
    from .command import members

    return members(study, plot)
