"""A single-point mooring as typed TOML.

[water]                   [attachment]        # of the hawser or buoy     [types.chain]
depth = 14.0              x = 50.0            # m ahead of midship        weight_kg_per_m = 241.4
                                                                          breaking_load_tonf = 785.0
[hull]                    [hawser]            # none: a contact buoy
length = 100.0            length = 25.0       # or a turret               [mooring]
beam = 50.0                                                               type = "chain"
draft = 10.0              [buoy]                                          length = 150.0
freeboard = 10.0          z = -3.0            # of the lines' ends        headings_deg = [30, 90, 150, 210, 270, 330]
                                                                          top_tension_tonf = 15.0
[mass]                    [wind]              [current]
added_surge = 0.1         speed = 25.0        speed_knots = 1.5           [waves]
added_sway = 0.6          incidence_deg = 0   incidence_deg = 30          height = 1.5
added_yaw = 0.4                               turning = {}                incidence_deg = 0
                                                                          drift_tonf_per_m2 = 4.99
Angles are those of `moor`: direction_deg travelled to from +x, or incidence_deg, 0 from +x.  Headings are the bow's.
Water and weather may come from the values of a site, [site] with file, state and level (`pipelines.site.link`).
"""

from __future__ import annotations

import msgspec

from ..common.line_tables import LineTable, TypeTable
from ..common.quantities import StudyError, Table
from ..common.typed import typed
from ..common.weather.seas import SystemsTable
from ..common.weather.streams import CurrentTable as UniformTable
from ..common.weather.streams import SuperstructureTable, WindTable
from ..common.weather.water import DepthTable
from ..site.link import SiteLink


class HullTable(SuperstructureTable, kw_only=True):
    """The hull

    length : m
    beam : m
    draft : m
    freeboard : m
    displacement : t, of the box if not given
    center : m, of mass ahead of midship
    """

    length: float
    beam: float
    draft: float
    freeboard: float | None = None
    displacement: float | None = None
    center: float = 0.0


class MassTable(Table):
    """Added mass of slow motion, over the body's own, in place of the database's

    added_surge : over the mass
    added_sway : over the mass
    added_yaw : over the moment of inertia
    gyration : m, in yaw, of a uniform box if not given
    """

    added_surge: float
    added_sway: float
    added_yaw: float
    gyration: float | None = None


class AttachmentTable(Table):
    """Where hawser or buoy is made fast to the hull

    x : m, from midship
    y : m, from the middle line
    z : m, over the water, in waves
    """

    x: float
    y: float = 0.0
    z: float = 0.0


class HawserTable(Table):
    """The hawser; without one the buoy touches the hull, as a turret does

    length : m, of each
    count : 1 or 2
    spacing : m, between the ends of two on the hull
    axial_stiffness : EA, for the scheme "full"
    breaking_load : B of T = B (ε/strain)^exponent, for the scheme "full"
    strain : at the breaking load
    exponent : of T = B (ε/strain)^exponent
    """

    length: float
    count: int = 1
    spacing: float = 0.0
    axial_stiffness_tonf: float | None = None
    axial_stiffness_kN: float | None = None
    breaking_load_tonf: float | None = None
    breaking_load_kN: float | None = None
    strain: float | None = None
    exponent: float = 1.0


class BuoyTable(Table):
    """The buoy; with mass, diameter and height it rises and sinks

    z : m, where the lines are made fast, below 0
    mass : t
    diameter : m
    height : m
    hawser_z : m over the water, where hawsers are made fast: it tilts under their pull, for the scheme "full"
    """

    z: float
    mass: float | None = None
    diameter: float | None = None
    height: float | None = None
    hawser_z: float | None = None


class MooringTable(LineTable, kw_only=True):
    """Equal lines from the buoy at rest

    headings_deg : of each, 0 → +x; or give count
    count : of lines, evenly around
    first_deg : heading of the first of count
    pretension : horizontal, at rest; or give top_tension
    top_tension : of a uniform line, along it at the buoy
    """

    headings_deg: list[float] | None = None
    count: int | None = None
    first_deg: float = 0.0
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    top_tension_tonf: float | None = None
    top_tension_kN: float | None = None


class TurningTable(Table):
    """Turning tests of a box; proportions in place of the hull's own

    length_over_beam : L/B
    beam_over_draft : B/d
    depth_over_draft : h/d
    """

    length_over_beam: float | None = None
    beam_over_draft: float | None = None
    depth_over_draft: float | None = None


class YawRateTable(Table):
    """Force by the yaw rate of a ship, linear, beside coefficients or file; those of Clarke et al. (1983) if not given

    Y_r : Y'_r over ½ρL³V, of side force
    N_r : N'_r over ½ρL⁴V, of yaw moment, at most 0
    """

    Y_r: float | None = None
    N_r: float | None = None


class CurrentTable(UniformTable):
    """Current on the hull, by one of turning, coefficients and file

    yaw_drag : kN m s², N₂, by default that of the cross flow on a box; turning tests contain it
    sway_damping : kN s/m, beside coefficients or file alone
    yaw_damping : kN m s, beside coefficients or file alone
    """

    turning: TurningTable | None = None
    yaw_rate: YawRateTable | None = None
    yaw_drag: float | None = None
    sway_damping: float = 0.0
    yaw_damping: float = 0.0


class WavesTable(SystemsTable):
    """The sea; it needs no period where the drift is not that of a database

    drift_tonf_per_m2 : of the square of the height, along the waves at every heading, in place of the database's drift
    """

    drift_tonf_per_m2: float | None = None


class AxisTable(Table):
    """A number of the study that is varied

    key : its name, as "hawser.length" or "hull.length_over_beam" (of the same volume)
    """

    key: str
    from_: float = msgspec.field(name="from")
    to: float
    count: int = 21


class MapTable(Table):
    """Growth of slewing over one or two numbers of the study

    x : the first number
    y : the second number
    """

    x: AxisTable
    y: AxisTable | None = None


class SlewingTable(Table):
    """A run in time

    duration : s
    step : s, of the record [1 s, of waves a thirtieth of their period]
    offset_deg : of the heading at its start from that of rest
    waves_after : s, when the waves are added
    scheme : "two_scale", with waves, "slow", without, or "full": slow and wave motion in one equation, with slow
        drift, and on a hawser the buoy as a body and the hawser elastic; by default the first where there are waves and
        a database
    slow_step : s, of the slow motion with waves
    tolerance : of place and heading, of the schemes slow and full
    components : of the waves
    seed : of gusts and waves
    """

    duration: float = 1200.0
    step: float | None = None
    offset_deg: float = 2.0
    waves_after: float = 0.0
    scheme: str | None = None
    slow_step: float = 10.0
    tolerance: float = 1e-4
    components: int = 50
    seed: int = 1


class Study(Table):
    """A hull on a buoy or turret

    allowable : fraction of the breaking load a line may carry, above 0, at most 1
    """

    water: DepthTable
    hull: HullTable
    attachment: AttachmentTable
    types: dict[str, TypeTable]
    mooring: MooringTable
    buoy: BuoyTable
    mass: MassTable | None = None
    hawser: HawserTable | None = None
    wind: WindTable | None = None
    current: CurrentTable | None = None
    waves: WavesTable | None = None
    site: SiteLink | None = None
    slewing: SlewingTable | None = None
    maps: list[MapTable] = msgspec.field(default_factory=list)
    allowable: float = 0.4


def make_study(raw):
    """The Study of nested dictionaries as TOML gives them.  Raises StudyError."""
    study = typed(raw, Study, StudyError)
    if not 0 < study.allowable <= 1:
        raise StudyError(f"allowable is {study.allowable:g}; allowed: above 0, at most 1")
    return study
