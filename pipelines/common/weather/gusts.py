"""Gusts of a study's wind."""

from hakobune.mooring.environment import gusts

from ..quantities import StudyError, speed

GUSTS = {"davenport": ("surface_drag",), "hino": ("surface_drag", "gust_height", "gust_exponent"),
         "npd": ("gust_height",), "kaimal": ("gust_height", "gust_intensity")}  # fmt: skip
GUST_DEFAULTS = {"surface_drag": 0.003, "gust_height": 10.0, "gust_exponent": 1 / 7, "gust_intensity": 0.12}


def gusts_of(table):
    """The GustSpectrum of a WindTable, None without gusts.  Raises StudyError."""
    if table is None or table.gusts is None:
        return None
    if table.gusts not in GUSTS:
        raise StudyError(f"wind.gusts is {table.gusts!r}; allowed: {', '.join(GUSTS)}")
    for name in GUST_DEFAULTS:
        if getattr(table, name) is not None and name not in GUSTS[table.gusts]:
            raise StudyError(
                f"wind.{name} is given for {table.gusts}; allowed with these gusts: {', '.join(GUSTS[table.gusts])}"
            )
    given = [getattr(table, name) for name in GUSTS[table.gusts]]
    values = [GUST_DEFAULTS[n] if v is None else v for n, v in zip(GUSTS[table.gusts], given, strict=True)]
    try:
        return getattr(gusts, table.gusts)(speed("wind", table), *values)
    except ValueError as error:
        raise StudyError(f"wind.gusts: {error}") from None
