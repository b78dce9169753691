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
Angles are as in `moor`: direction_deg, the direction of travel from +x, or incidence_deg, 0 from +x.
Headings are the headings of the bow.
Water and weather may come from the values of a site, [site] with file, state and level (`pipelines.site.link`).
"""

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
    """Dimensions and mass of the hull

    length : m, length of the hull
    beam : m, beam of the hull
    draft : m, draft of the hull
    freeboard : m, height of the deck above still water; needed with wind unless wind.file is given
    displacement : t, mass of the hull; by default the displaced mass of a box of this length, beam and draft
    center : m, distance of the centre of mass ahead of midship
    """

    length: float
    beam: float
    draft: float
    freeboard: float | None = None
    displacement: float | None = None
    center: float = 0.0


class MassTable(Table):
    """Added mass of the slow motion over the mass of the body, in place of the added mass of the database

    added_surge : added mass in surge, over the mass of the body
    added_sway : added mass in sway, over the mass of the body
    added_yaw : added moment of inertia in yaw, over the body's moment of inertia
    gyration : m, radius of gyration in yaw; by default the radius of a uniform box
    """

    added_surge: float
    added_sway: float
    added_yaw: float
    gyration: float | None = None


class AttachmentTable(Table):
    """Point of the hull where the hawser or the buoy is attached

    x : m, distance ahead of midship
    y : m, distance from the centre line, positive to port
    z : m, height above still water, used with waves
    """

    x: float
    y: float = 0.0
    z: float = 0.0


class HawserTable(Table):
    """The hawser between buoy and hull; without this table the buoy touches the hull, as a turret does

    length : m, length of each hawser
    count : number of hawsers, 1 or 2
    spacing : m, distance between the two ends on the hull
    axial_stiffness : axial stiffness EA, for the scheme "full"
    breaking_load : breaking load B in T = B (ε/strain)^exponent, needed for the scheme "full"
    strain : strain at the breaking load, 0.1 for 10 %
    exponent : exponent in T = B (ε/strain)^exponent
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
    """The buoy that the lines hold; a buoy with mass or draft, diameter and height also rises and sinks

    z : m, height of the lines' upper ends above still water, below 0; with mass without the lines' weight, else at rest
    mass : t, mass of the buoy; or give draft
    draft : m, draft at rest with its lines and without the hull, in place of mass
    diameter : m, diameter of the buoy
    height : m, height of the buoy
    hawser_z : m, height of the hawsers' ends above still water; if given, the hawsers tilt the buoy in the scheme
        "full"
    """

    z: float
    mass: float | None = None
    draft: float | None = None
    diameter: float | None = None
    height: float | None = None
    hawser_z: float | None = None


class MooringTable(LineTable, kw_only=True):
    """Equal lines from the buoy at rest

    headings_deg : heading of each line, 0 → +x; or give count
    count : number of lines, evenly spaced around the buoy; or give headings_deg
    first_deg : heading of the first line when count is given
    pretension : horizontal tension of each line at rest; or give top_tension
    top_tension : tension at the upper end of a uniform line at rest; or give pretension
    """

    headings_deg: list[float] | None = None
    count: int | None = None
    first_deg: float = 0.0
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    top_tension_tonf: float | None = None
    top_tension_kN: float | None = None


class TurningTable(Table):
    """Current forces from turning tests of a box; proportions given here replace those of the hull

    length_over_beam : ratio L/B
    beam_over_draft : ratio B/d
    depth_over_draft : ratio h/d
    """

    length_over_beam: float | None = None
    beam_over_draft: float | None = None
    depth_over_draft: float | None = None


class YawRateTable(Table):
    """Linear force due to the yaw rate of a ship, where coefficients, a file or a type of ship give the current force;
    by default after Clarke et al. (1983)

    Y_r : coefficient Y'_r of the side force, referred to ½ρL³V
    N_r : coefficient N'_r of the yaw moment, referred to ½ρL⁴V, at most 0
    """

    Y_r: float | None = None
    N_r: float | None = None


class CurrentTable(UniformTable):
    """Current on the hull: turning tests, coefficients, a file or a type of ship, one of the four

    yaw_drag : kN m s², yaw moment N₂ over the square of the yaw rate; by default that of the cross flow on a box;
        refused with turning tests, which include this moment
    sway_damping : kN s/m, linear damping of sway, only with coefficients or a file
    yaw_damping : kN m s, linear damping of yaw, only with coefficients or a file
    """

    turning: TurningTable | None = None
    yaw_rate: YawRateTable | None = None
    yaw_drag: float | None = None
    sway_damping: float = 0.0
    yaw_damping: float = 0.0


class WavesTable(SystemsTable):
    """The sea; its period may be left out where drift_tonf_per_m2 is given

    drift_tonf_per_m2 : drift force over the square of the wave height; it acts in the wave direction at every
        heading, in place of the database's drift
    """

    drift_tonf_per_m2: float | None = None


class AxisTable(Table):
    """One number of the study that is varied over a range

    key : name of the number, as "hawser.length" or "hull.length_over_beam" (at constant volume)
    """

    key: str
    from_: float = msgspec.field(name="from")
    to: float
    count: int = 21


class MapTable(Table):
    """A map of the growth rate of slewing over one or two numbers of the study

    x : number of the study along the horizontal axis
    y : number of the study along the vertical axis; by default the map is a curve over x
    """

    x: AxisTable
    y: AxisTable | None = None


class SlewingTable(Table):
    """A simulation of slewing in time

    duration : s, length of the simulation
    step : s, sampling interval of the record; by default 1 s, with waves a thirtieth of their period
    offset_deg : initial heading relative to the heading at rest
    waves_after : s, time at which the waves begin
    scheme : "two_scale", slow and wave motion in separate equations, for a study with waves; "slow", slow motion
        alone; or "full", slow and wave motion in one equation with slow drift. With a hawser, "full" also moves the
        buoy as a body on an elastic hawser. By default "two_scale" where there are waves and a database, otherwise
        "slow"
    slow_step : s, step of the slow motion in the scheme "two_scale"
    tolerance : error of position and heading in the schemes "slow" and "full"
    components : number of wave components
    seed : seed of the random phases of gusts and waves; the same seed gives the same record
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

    allowable : fraction of the breaking load that a line or rope may carry (OCIMF MEG4: 0.5 of ropes, 0.55 of wires)
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
    """The Study of nested dictionaries read from TOML.  Raises StudyError."""
    study = typed(raw, Study, StudyError)
    if not 0 < study.allowable <= 1:
        raise StudyError(f"allowable is {study.allowable:g}; allowed: above 0, at most 1")
    return study
