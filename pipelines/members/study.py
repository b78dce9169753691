"""Slender members in water and wind as typed TOML.

[water]            [wave]                  [[members]]                 [[wind_members]]
depth = 12.0       height = 3.0            name = "fore"               name = "crane"
                   period = 8.0            shape = "circular"          shape = "isolated member"
[current]          direction_deg = 0       width = 1.2                 area = 14.0
speed = 1.0                                start = [0.0, 0.0, -12.0]   position = [2.0, 0.0, 9.0]
direction_deg = 0  [wind]                  end = [0.0, 0.0, 3.0]
                   speed = 30.0            drag = 1.0
                   direction_deg = 0       growth = 0.05
"""

import msgspec
import numpy as np

from hakobune.mooring.environment.current_profile import power_law
from hakobune.mooring.loads import members as wind_loads
from hakobune.mooring.loads.morison import circular, plate, square
from hakobune.mooring.loads.over_wave import Member
from hakobune.mooring.loads.regular_wave import RegularWave
from hakobune.mooring.seas.breaking import breaking_height

from ..common.quantities import StudyError, Table, direction, positive, water_density, water_depth
from ..common.typed import read_toml, typed
from ..common.weather.water import DepthTable, WaveTable

SHAPES = {"circular": circular, "square": square, "plate": plate}
THICKEST = 1.0  # m of growth
MOST = 1000  # members


class WaterTable(DepthTable):
    """Water at the place"""

    density: float = 1025.0


class CurrentTable(Table):
    """A current

    speed : m/s, speed at the surface
    exponent : exponent of the profile over the depth: 0 for a uniform current, 0.143 for tides, 1 for wind drift
    """

    speed: float
    exponent: float = 0.0
    direction_deg: float | None = None
    incidence_deg: float | None = None


class WindTable(Table):
    """Wind at 10 m above the sea

    speed : m/s, mean wind speed
    exponent : exponent of the profile over the height; by default the table of the SR179 report
    """

    speed: float
    exponent: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None


class MemberTable(Table):
    """A straight member in the water, partly or wholly submerged

    name : name of the member in results
    shape : shape of the section: circular, square (moved along a side) or plate (across the flow)
    width : m, diameter or side without marine growth
    start : m, x, y, z of one end, z up from still water
    end : m, x, y, z of the other end
    drag : drag coefficient C_D, referred to the width with growth
    inertia : inertia coefficient C_M; by default that of potential flow: 2 for circular, 2.19 for square, 1 for plate
    growth : m, thickness of the marine growth
    """

    name: str
    shape: str
    width: float
    start: tuple[float, float, float]
    end: tuple[float, float, float]
    drag: float
    inertia: float | None = None
    growth: float = 0.0


class WindMemberTable(Table):
    """A member in the wind

    name : name of the member in results
    shape : shape that gives the drag coefficient: sphere, cylinder, hull side, deck house, isolated member …; or give
        drag
    drag : drag coefficient, in place of a shape
    area : m², projected area along the wind
    position : m, x, y, z of the centre of the area
    """

    name: str
    area: float
    position: tuple[float, float, float]
    shape: str | None = None
    drag: float | None = None


class MembersStudy(Table):
    """Members of a structure in waves, current and wind"""

    water: WaterTable
    wave: WaveTable | None = None
    current: CurrentTable | None = None
    wind: WindTable | None = None
    members: list[MemberTable] = msgspec.field(default_factory=list)
    wind_members: list[WindMemberTable] = msgspec.field(default_factory=list)


def read_study(path):
    """The MembersStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_toml(path, "a study of members", StudyError)
    return make_study(raw), text


def make_study(raw):
    """The MembersStudy of nested dictionaries.  Raises StudyError."""
    study = typed(raw, MembersStudy, StudyError)
    if not study.members and not study.wind_members:
        raise StudyError("there are no members; give at least one [[members]] or [[wind_members]]")
    if len(study.members) > MOST:
        raise StudyError(f"there are {len(study.members)} members; allowed: at most {MOST}")
    water_density("water.density", study.water.density)
    if study.members and study.wave is None and study.current is None:
        raise StudyError("there is neither wave nor current; give [wave], [current] or both")
    if study.wind_members and study.wind is None:
        raise StudyError("wind is missing; [[wind_members]] need it")
    return study


def wave_of(study):
    """`RegularWave` of a study, of zero height if the study has only a current.  Raises StudyError, ValueError."""
    depth, current, wave = water_depth("water.depth", study.water.depth), None, study.wave
    if study.current is not None:
        towards = direction("current", study.current)
        current = power_law(study.current.speed, towards, depth, study.current.exponent)
    if wave is None:
        return RegularWave(0.0, 1.0, 0.0, depth, current)
    height, period = positive("wave.height", wave.height), positive("wave.period", wave.period)
    highest = float(breaking_height(period, depth))
    if height > highest:
        raise StudyError(
            f"wave.height is {height:g} m; a wave of {period:g} s breaks at {highest:.3g} m in {depth:g} m of water"
        )
    made = RegularWave(0.5 * height, 2 * np.pi / period, direction("wave", wave), depth, current)
    if made.against >= made.energy_speed:
        raise StudyError(
            f"current runs at {made.against:.3g} m/s against a wave of {period:g} s, whose energy travels at "
            f"{made.energy_speed:.3g} m/s: no such wave reaches the members; allowed: a slower current or a longer wave"
        )
    return made


def placed(study):
    """[`mooring.loads.over_wave.Member`] of a study.  Raises StudyError naming the member."""
    return [_placed(member, study.water.depth) for member in study.members]


def _placed(member, depth):
    where = f"member {member.name!r}"
    if member.shape not in SHAPES:
        raise StudyError(f"{where}: shape is {member.shape!r}; allowed: {', '.join(SHAPES)}")
    if not 0 <= member.growth <= THICKEST:
        raise StudyError(f"{where}: growth is {member.growth:g} m; allowed: 0 to {THICKEST:g}")
    start, end = np.array(member.start), np.array(member.end)
    if not np.all(np.isfinite([start, end])) or not np.linalg.norm(end - start) > 0:
        raise StudyError(f"{where} goes from {member.start} to {member.end}; allowed: two different finite points")
    lowest = min(start[2], end[2])
    if lowest < -depth * (1 + 1e-9):
        raise StudyError(f"{where} reaches down to z = {lowest:g} m; allowed: at least {-depth:g} m, the sea bed")
    inertia = () if member.inertia is None else (member.inertia,)
    try:
        section = SHAPES[member.shape](member.width + 2 * member.growth, member.drag, *inertia)
    except ValueError as error:
        raise StudyError(f"{where}: {error}") from None
    return Member(member.name, section, start, end)


def wind_on(study):
    """[(name, wind force and moment about the origin (6,), N and N m)] of the members in the wind.  Raises
    StudyError, ValueError.
    """
    if study.wind is None:
        return []
    towards, found = direction("wind", study.wind), []
    for one in study.wind_members:
        if (one.shape is None) == (one.drag is None):
            raise StudyError(f"wind member {one.name!r}: give one of shape, drag")
        if not np.all(np.isfinite(one.position)):
            raise StudyError(f"wind member {one.name!r}: position is {list(one.position)}; allowed: finite")
        member = wind_loads.Member(one.drag if one.shape is None else one.shape, one.area, one.position)
        force = wind_loads.wind_on_members([member], study.wind.speed, towards, study.wind.exponent)
        found.append((one.name, force))
    return found
