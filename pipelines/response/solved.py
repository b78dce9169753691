"""A response study on a database: a SeaState, a Climate, or a body on its lines."""

import warnings

FRACTILE = 0.9  # probability that the value is not exceeded


def solved_in_sea(read, body, db, points, _):
    """SeaState, and the body with its viscous damping in this sea"""
    from hakobune.mooring.on_current.body import on_current
    from hakobune.mooring.on_current.waves import carrier_of
    from hakobune.mooring.response.pair_levels import beside_newman
    from hakobune.mooring.response.sea_state import sea_state
    from hakobune.mooring.response.viscous import in_sea

    from ..common.quantities import StudyError, level_of, positive
    from ..common.weather.seas import sea_with_swell
    from .study import viscous_laws, viscous_words

    level = level_of("sea.qtf", read.sea.qtf)
    if db.bodies and level != "newman":
        raise StudyError(f'sea.qtf is "{level}", but {db.path} contains {len(db.bodies)} bodies; allowed: "newman"')
    duration = 3600 * positive("sea.duration_hours", read.sea.duration_hours)
    sea, laws = sea_with_swell("sea", read.sea, db.water_depth), viscous_laws(read, db)
    body = on_current(body, carrier_of(read.stream()))
    body, damping = in_sea(db.bodies_reader, sea, laws, body)
    for line in viscous_words(body, laws, damping):
        warnings.warn(line, stacklevel=2)
    bound, said = beside_newman(db, sea, level, spread=True)
    for line in said:
        warnings.warn(line, stacklevel=2)
    return sea_state(body, sea, duration, points, bound), body


def solved_moored(read, db, points, path):
    from ..common.quantities import StudyError, positive
    from ..common.weather.seas import sea_with_swell
    from .moored import moored, moored_together

    if read.sea.qtf != "newman":
        raise StudyError(f"sea.qtf is {read.sea.qtf!r}; allowed with --moored: newman")
    sea = sea_with_swell("sea", read.sea, db.water_depth)
    duration = 3600 * positive("sea.duration_hours", read.sea.duration_hours)
    return (moored_together if db.bodies else moored)(path, read, db, sea, duration, points)


def solved_in_climate(read, body, db, points, beside):
    from ..common.quantities import StudyError

    if read.body.viscous is not None:
        raise StudyError("body.viscous is linearised in one sea; give damping_ratio for a climate")
    if db.has_viscous_motions:
        warnings.warn(
            "viscous damping of the database's scene is left out in a climate, since each sea has its own "
                "equivalent damping: " + ("body.damping_ratio takes its place" if read.body.damping_ratio else
                       "motions near resonance are too large; give body.damping_ratio"), stacklevel=2
        )  # fmt: skip
    from hakobune.mooring.response.climate import climate

    from .effort import check_effort
    from .study import climate_of

    given = climate_of(read.climate, beside, body.depth)
    check_effort(read, given["scatter"])
    return climate(body, **given, points=points), body
