"""A floating breakwater on taut lines, per metre of its length, in given waves; SI.

From its section to bodies on their lines and floating bodies, at every water level.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from hakobune.bem.sections.outline import OutlineError, circle, closed, rectangle

from ...breakwater.body import FloatingBody, TautBody
from ...breakwater.long_waves import equal_area
from ...breakwater.taut import TautRectangle
from ...environment.sea import Sea

TONNE, KN = 1e3, 1e3  # kg, N
CLEAR = 0.01  # part of a line, from the body, within which contact with the body is ignored
THEORIES = ("potential flow", "long waves")


class BreakwaterError(ValueError):
    """Error for a breakwater that is impossible or outside a theory; the message names the value and the limit."""


class Water(NamedTuple):
    """depth : depth at mean level, m; tide : amplitude above and below mean level, m; density : kg/m³; gravity :
    m/s²
    """

    depth: float
    tide: float = 0.0
    density: float = 1025.0
    gravity: float = 9.80665


class Section(NamedTuple):
    """shape : rectangle (beam, height), circle (diameter), or outline (points [y, z] or [y, z, bulge], the last
    equal to the first); draft : draft on the lines at mean level; all in m
    """

    shape: str
    draft: float
    beam: float | None = None
    height: float | None = None
    diameter: float | None = None
    points: list | None = None


class Body(NamedTuple):
    """center_of_gravity : height above the lowest point, m; gyration : m; mass : kg/m, or free_draft : m. Without
    both the weight follows from the pretension of the lines
    """

    center_of_gravity: float
    gyration: float
    mass: float | None = None
    free_draft: float | None = None


class Lines(NamedTuple):
    """Pairs of lines. angle : angle with the bed, rad; attachment : half the distance of their upper ends, m;
    attachment_height : above the lowest point, m; length : m, None for lines to the bed; spacing : distance between
        pairs, m
    pretension : N per metre of body, in place of its weight; allowable, axial_stiffness : of one line, N
    """

    angle: float
    attachment: float
    attachment_height: float = 0.0
    length: float | None = None
    spacing: float = 1.0
    pretension: float | None = None
    allowable: float | None = None
    axial_stiffness: float | None = None

    @property
    def stretch(self):
        """Axial stiffness EA of the lines, N per metre of body, None for inextensible lines"""
        return None if self.axial_stiffness is None else self.axial_stiffness / self.spacing


class Waves(NamedTuple):
    """Regular waves.  height : m; period : (n,) s, ascending; obliquity : rad, angle of travel to the normal"""

    height: float
    period: np.ndarray
    obliquity: float = 0.0


@dataclass(frozen=True, eq=False)
class Breakwater:
    """A breakwater and its waves. `rise` is the height of the water above its mean level, m.

    body : None for a fixed one; sea : its direction is the angle to the normal; duration : s, of the sea
    holdings, theories : compared holdings and theories, of `holdings.HOLDINGS` and THEORIES; loss : C of C U²/2g
        under the keel
    chosen : (holding, theory) for the tensions; a holding None means the first holding with lines. Raises
        BreakwaterError for impossible bodies and lines.
    """

    water: Water
    section: Section
    waves: Waves
    body: Body | None = None
    lines: Lines | None = None
    sea: Sea | None = None
    duration: float = 10800.0
    holdings: tuple = ("fixed",)
    theories: tuple = THEORIES[:1]
    chosen: tuple = (None, THEORIES[0])
    loss: float | None = None

    def __post_init__(self):
        for _, rise in self.levels:
            self.wetted(rise)
        if self.lines is not None:
            self._check_clear()
        if self.body is not None:
            _ = self.mass
            self._check_stretch()

    @cached_property
    def outline(self):
        section = self.section
        try:
            if section.shape == "rectangle":
                return rectangle(section.beam, section.height)
            return circle(section.diameter) if section.shape == "circle" else outline_of(section.points)
        except OutlineError as error:
            raise BreakwaterError(f"section: {error}") from None

    @property
    def levels(self):
        """Return (name, rise) of the water levels, the mean one first"""
        tide = self.water.tide
        return [("mean", 0.0), ("low", -tide), ("high", tide)] if tide else [("mean", 0.0)]

    @property
    def fluid(self):
        """{"density": kg/m³, "gravity": m/s²}"""
        return {"density": self.water.density, "gravity": self.water.gravity}

    @property
    def weight(self):
        """ρg, N/m³"""
        return self.water.density * self.water.gravity

    @property
    def loses_exactly(self):
        """Whether `bem.sections.keel_loss`, for rectangles, computes the head loss under the keel"""
        return self.loss is not None and self.section.shape == "rectangle"

    @property
    def design(self):
        """(holding, theory) for the tensions: as chosen, otherwise the first holding with lines"""
        held = [holding for holding in self.holdings if holding in ("taut", "elastic")]
        return self.chosen[0] or (held or self.holdings)[0], self.chosen[1]

    @property
    def angle(self):
        """α, rad, or None without lines"""
        return None if self.lines is None else self.lines.angle

    def depth(self, rise):
        """m"""
        return self.water.depth + rise

    def draft(self, rise):
        """m, on the lines"""
        return self.section.draft + rise

    def wetted(self, rise):
        """`Wetted` on the lines"""
        draft = self.draft(rise)
        if not draft < self.depth(rise):
            raise BreakwaterError(f"section.draft is {draft:g} m in {self.depth(rise):g} m of water; allowed: less")
        at = "" if rise == 0 else f" with the water at {rise:+g} m"
        try:
            return self.outline.wetted(draft)
        except OutlineError as error:
            raise BreakwaterError(f"section{at}: {error}") from None

    @property
    def line(self):
        """S, m"""
        lines, section = self.lines, self.section
        below = self.water.depth - section.draft + lines.attachment_height
        to_bed = below / np.sin(self.angle)
        if lines.length is not None and lines.length > to_bed * (1 + 1e-9):
            raise BreakwaterError(
                f"lines.length is {lines.length:g} m, but a line at {np.degrees(self.angle):.6g}° reaches the bed "
                f"after {to_bed:.4g} m; allowed: up to that length"
            )
        return to_bed if lines.length is None else lines.length

    @cached_property
    def mass(self):
        """kg/m"""
        body, lines, density = self.body, self.lines, self.water.density
        if body.mass is not None:
            mass, key = body.mass, f"body.mass is {body.mass / TONNE:g} t/m"
        elif body.free_draft is not None:
            try:
                mass = density * self.outline.wetted(body.free_draft).area
            except OutlineError as error:
                raise BreakwaterError(f"body.free_draft: {error}") from None
            key = f"body.free_draft is {body.free_draft:g} m"
        else:
            pull = 2 * lines.pretension * np.sin(self.angle) / self.water.gravity
            mass, key = (
                density * self.wetted(0.0).area - pull,
                f"lines.pretension is {lines.pretension / KN:g} kN/m",
            )
        if mass <= 0:
            raise BreakwaterError(f"{key}: the body would weigh {mass / TONNE:.4g} t/m; allowed: above 0")
        buoyant = density * min(self.wetted(rise).area for _, rise in self.levels)
        if lines is not None and mass > buoyant:
            raise BreakwaterError(
                f"{key}: the body weighs {mass / TONNE:.4g} t/m and displaces {buoyant / TONNE:.4g} t/m at least, so "
                "the pretension is negative; give a lighter body or more draft"
            )
        return mass

    def pretension(self, rise):
        """P₀ of a line, N/m, or None if the weight is unknown"""
        if self.body is None:
            return None
        excess = self.water.density * self.wetted(rise).area - self.mass
        return self.water.gravity * excess / (2 * np.sin(self.angle))

    def tide_tension(self, rise):
        """Change of P₀, N/m, from mean level"""
        more = self.wetted(rise).area - self.wetted(0.0).area
        return self.weight * more / (2 * np.sin(self.angle))

    def taut(self, rise):
        """`TautBody`"""
        body, lines, wetted = self.body, self.lines, self.mirrored(self.wetted(rise))
        lowest = -wetted.draft
        return TautBody(
            mass=self.mass, z0=lowest + body.center_of_gravity, inertia=self.mass * body.gyration**2, area=wetted.area,
            buoyancy_z=wetted.center.imag, waterline=wetted.waterline, draft=wetted.draft, depth=self.depth(rise),
            angle=self.angle, attachment=lines.attachment, attachment_z=lowest + lines.attachment_height,
            line=self.line, **self.fluid,
        )  # fmt: skip

    def taut_rectangle(self, rise):
        """`TautRectangle` of the long-wave theory"""
        lines, draft = self.lines, self.draft(rise)
        if self.section.shape != "rectangle" or lines.attachment_height:
            raise BreakwaterError(
                "the theory of long waves on taut lines needs a rectangle with lines.attachment_height = 0"
            )
        body, beam = self.body, self.section.beam
        return TautRectangle(
            half=beam / 2, draft=draft, free_draft=self.mass / self.water.density / beam, depth=self.depth(rise),
            z0=body.center_of_gravity - draft, inertia=self.mass * body.gyration**2, angle=self.angle,
            attachment=lines.attachment, line=self.line, **self.fluid,
        )  # fmt: skip

    def afloat(self, rise):
        """`FloatingBody` without lines, and its `Wetted`"""
        draft = self.outline.draft_of(self.mass / self.water.density)
        try:
            wetted = self.mirrored(self.outline.wetted(draft))
        except OutlineError as error:
            raise BreakwaterError(f"the section does not float without lines: {error}") from None
        body = self.body
        return FloatingBody(
            mass=self.mass, z0=body.center_of_gravity - draft, inertia=self.mass * body.gyration**2, area=wetted.area,
            buoyancy_z=wetted.center.imag, waterline=wetted.waterline, draft=draft, depth=self.depth(rise),
            **self.fluid,
        ), wetted  # fmt: skip

    def equal_rectangle(self, rise):
        """Half width and draft of the rectangle of the long-wave theory, m"""
        section, draft = self.section, self.draft(rise)
        if section.shape == "rectangle":
            return section.beam / 2, draft
        if section.shape == "circle":
            return equal_area(section.diameter, draft)
        raise BreakwaterError("section.shape is 'outline'; the theory of long waves needs a rectangle or a circle")

    def mirrored(self, wetted):
        """The `Wetted`, checked to be symmetric about y = 0.  Raises BreakwaterError otherwise."""
        if not wetted.symmetric:
            raise BreakwaterError(
                "the section is not symmetric about y = 0; this is required if it moves or if [loss] is given"
            )
        return wetted

    def changed(self, draft=None, width=None, angle=None):
        """The breakwater with a changed draft, width (m) or line angle (rad).

        The body scales with its section: vertical dimensions with its height, horizontal dimensions with its width
        """
        section, body, lines = self.section, self.body, self.lines
        across = "diameter" if section.shape == "circle" else "beam"
        wide = getattr(section, across)
        draft, width = draft or section.draft, width or wide
        wider, deeper = width / wide, draft / section.draft
        upright = wider if section.shape == "circle" else deeper
        sizes = {across: width, "draft": draft}
        if section.height is not None:
            sizes["height"] = section.height * deeper
        lines = lines._replace(
            angle=angle or lines.angle, attachment=lines.attachment * wider,
            attachment_height=lines.attachment_height * upright,
        )  # fmt: skip
        if body is not None:
            body = body._replace(
                center_of_gravity=body.center_of_gravity * upright, gyration=body.gyration * wider,
                mass=None if body.mass is None else body.mass * wider * deeper,
                free_draft=None if body.free_draft is None else body.free_draft * deeper,
            )  # fmt: skip
        return replace(self, section=section._replace(**sizes), body=body, lines=lines)

    def _check_stretch(self):
        """Raise BreakwaterError where the pretension would stretch the lines to twice their length."""
        lines = self.lines
        if lines is None or lines.axial_stiffness is None:
            return
        most = max(self.pretension(rise) for _, rise in self.levels) * lines.spacing
        if 2 * most > lines.axial_stiffness:
            raise BreakwaterError(
                f"lines.axial_stiffness is {lines.axial_stiffness / KN:g} kN and the pretension of a line is "
                f"up to {most / KN:.4g} kN: the line would stretch by more than half of its length; give a "
                "stiffer line or a heavier body"
            )

    def beside(self):
        """A message if the lines' upper ends are outside the body, or nothing"""
        lines = self.lines
        if lines is None:
            return
        away = self.outline.distance(complex(lines.attachment, self.outline.bottom + lines.attachment_height))
        if away > CLEAR * self.line:
            yield (
                f"lines.attachment is {lines.attachment:g} m and attachment_height {lines.attachment_height:g} "
                f"m, {away:.3g} m off the body: the lines are computed as if rigid arms held them there"
            )

    def _check_clear(self):
        """Raise BreakwaterError where a line would pass through the body."""
        lines = self.lines
        height = self.outline.bottom + lines.attachment_height
        down = self.line * np.exp(-1j * self.angle)
        ways = [(side * lines.attachment + 1j * height, complex(side * down.real, down.imag)) for side in (1, -1)]
        if any(self.outline.meets(top + CLEAR * way, top + way) for top, way in ways):
            raise BreakwaterError(
                f"lines: at an angle of {np.degrees(lines.angle):.6g}° a line from y = {lines.attachment:g} m, "
                f"{lines.attachment_height:g} m above the lowest point, passes through the body; allowed: lines that "
                "stay outside the body; change angle, attachment or attachment_height"
            )


def outline_of(points):
    """`Outline` of rows y, z and bulge, where the last point equals the first.  Raises OutlineError."""
    rows = np.array([[*point, 0.0][:3] for point in points])
    places = rows[:, 0] + 1j * rows[:, 1]
    if len(rows) < 3 or places[0] != places[-1]:
        gap = f"the last point is {abs(places[-1] - places[0]):.3g} m from the first" if len(rows) else "there is none"
        raise OutlineError(f"the outline is not closed: {gap}; allowed: a last point equal to the first")
    return closed(places[:-1], rows[:-1, 2])
