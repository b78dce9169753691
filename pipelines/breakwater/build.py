"""From a study to sections, bodies on their lines and bodies afloat, at every level of the water."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hakobune.bem.sections.outline import OutlineError, circle, closed, rectangle
from hakobune.mooring.breakwater.body import FloatingBody, TautBody
from hakobune.mooring.breakwater.long_waves import equal_area
from hakobune.mooring.breakwater.taut import TautRectangle

from ..common.quantities import StudyError

TONNE, KN = 1e3, 1e3  # kg, N
CLEAR = 0.01  # of a line, within which it may touch the body it is fixed to


@dataclass(frozen=True, eq=False)
class Breakwater:
    """A BreakwaterStudy in SI units.  `rise` is that of the water above its mean level, m.

    Raises StudyError for bodies and lines that cannot be.
    """

    study: object

    def __post_init__(self):
        for _, rise in self.levels:
            self.wetted(rise)
        if self.study.lines is not None:
            self._check_clear()
        if self.study.body is not None:
            _ = self.mass
            self._check_stretch()

    @cached_property
    def outline(self):
        section = self.study.section
        try:
            if section.shape == "rectangle":
                return rectangle(section.beam, section.height)
            return circle(section.diameter) if section.shape == "circle" else outline_of(section.points)
        except OutlineError as error:
            raise StudyError(f"section: {error}") from None

    @property
    def levels(self):
        """(name, rise) of the water, the mean one first"""
        tide = self.study.water.tide
        return [("mean", 0.0), ("low", -tide), ("high", tide)] if tide else [("mean", 0.0)]

    @property
    def water(self):
        """{"density": kg/m³, "gravity": m/s²}"""
        return {"density": self.study.water.density, "gravity": self.study.water.gravity}

    @property
    def weight(self):
        """ρg, N/m³"""
        return self.study.water.density * self.study.water.gravity

    @property
    def loses_exactly(self):
        """Whether the flow under the keel loses head by `bem.sections.keel_loss`, which is of rectangles"""
        return self.study.loss is not None and self.study.section.shape == "rectangle"

    @property
    def obliquity(self):
        """Angle of the regular waves with the normal, rad"""
        return np.radians(self.study.waves.obliquity_deg)

    @property
    def angle(self):
        """α, rad, or None without lines"""
        return None if self.study.lines is None else np.radians(self.study.lines.angle_deg)

    def depth(self, rise):
        """m"""
        return self.study.water.depth + rise

    def draft(self, rise):
        """m, on the lines"""
        return self.study.section.draft + rise

    def wetted(self, rise):
        """`Wetted` on the lines"""
        draft = self.draft(rise)
        if not draft < self.depth(rise):
            raise StudyError(f"section.draft is {draft:g} m in {self.depth(rise):g} m of water; allowed: less")
        at = "" if rise == 0 else f" with the water at {rise:+g} m"
        try:
            return self.outline.wetted(draft)
        except OutlineError as error:
            raise StudyError(f"section{at}: {error}") from None

    @property
    def line(self):
        """S, m"""
        lines, section = self.study.lines, self.study.section
        below = self.study.water.depth - section.draft + lines.attachment_height
        to_bed = below / np.sin(self.angle)
        if lines.length is not None and lines.length > to_bed * (1 + 1e-9):
            raise StudyError(
                f"lines.length is {lines.length:g} m, to the bed at {lines.angle_deg:g}° it is {to_bed:.4g} m; "
                "allowed: up to that"
            )
        return to_bed if lines.length is None else lines.length

    @cached_property
    def mass(self):
        """kg/m"""
        body, lines, density = self.study.body, self.study.lines, self.study.water.density
        if body.mass_t_per_m is not None:
            mass, key = body.mass_t_per_m * TONNE, f"body.mass_t_per_m is {body.mass_t_per_m:g}"
        elif body.free_draft is not None:
            try:
                mass = density * self.outline.wetted(body.free_draft).area
            except OutlineError as error:
                raise StudyError(f"body.free_draft: {error}") from None
            key = f"body.free_draft is {body.free_draft:g} m"
        else:
            pull = 2 * lines.pretension_kN_per_m * KN * np.sin(self.angle) / self.study.water.gravity
            mass, key = (
                density * self.wetted(0.0).area - pull,
                f"lines.pretension_kN_per_m is {lines.pretension_kN_per_m:g}",
            )
        if mass <= 0:
            raise StudyError(f"{key}: the body would weigh {mass / TONNE:.4g} t/m; allowed: above 0")
        buoyant = density * min(self.wetted(rise).area for _, rise in self.levels)
        if lines is not None and mass > buoyant:
            raise StudyError(
                f"{key}: the body weighs {mass / TONNE:.4g} t/m and displaces {buoyant / TONNE:.4g} at least, the "
                "pretension is negative; give a lighter body or more draft"
            )
        return mass

    def pretension(self, rise):
        """P₀ of a line, N/m, or None where the weight is not known"""
        if self.study.body is None:
            return None
        excess = self.study.water.density * self.wetted(rise).area - self.mass
        return self.study.water.gravity * excess / (2 * np.sin(self.angle))

    def tide_tension(self, rise):
        """Change of P₀, N/m, from mean level"""
        more = self.wetted(rise).area - self.wetted(0.0).area
        return self.weight * more / (2 * np.sin(self.angle))

    def taut(self, rise):
        """`TautBody`"""
        body, lines, wetted = self.study.body, self.study.lines, self.mirrored(self.wetted(rise))
        lowest = -wetted.draft
        return TautBody(
            mass=self.mass, z0=lowest + body.center_of_gravity, inertia=self.mass * body.gyration**2, area=wetted.area,
            buoyancy_z=wetted.center.imag, waterline=wetted.waterline, draft=wetted.draft, depth=self.depth(rise),
            angle=self.angle, attachment=lines.attachment, attachment_z=lowest + lines.attachment_height,
            line=self.line, **self.water,
        )  # fmt: skip

    def taut_rectangle(self, rise):
        """`TautRectangle` of the long-wave theory"""
        lines, draft = self.study.lines, self.draft(rise)
        if self.study.section.shape != "rectangle" or lines.attachment_height:
            raise StudyError("theory long waves on taut lines needs a rectangle with lines.attachment_height 0")
        body, beam = self.study.body, self.study.section.beam
        return TautRectangle(
            half=beam / 2, draft=draft, free_draft=self.mass / self.study.water.density / beam, depth=self.depth(rise),
            z0=body.center_of_gravity - draft, inertia=self.mass * body.gyration**2, angle=self.angle,
            attachment=lines.attachment, line=self.line, **self.water,
        )  # fmt: skip

    def afloat(self, rise):
        """`FloatingBody` without lines, and its `Wetted`"""
        draft = self.outline.draft_of(self.mass / self.study.water.density)
        try:
            wetted = self.mirrored(self.outline.wetted(draft))
        except OutlineError as error:
            raise StudyError(f"section afloat without lines: {error}") from None
        body = self.study.body
        return FloatingBody(
            mass=self.mass, z0=body.center_of_gravity - draft, inertia=self.mass * body.gyration**2, area=wetted.area,
            buoyancy_z=wetted.center.imag, waterline=wetted.waterline, draft=draft, depth=self.depth(rise),
            **self.water,
        ), wetted  # fmt: skip

    def equal_rectangle(self, rise):
        """Half width and draft of the rectangle of the long-wave theory, m"""
        section, draft = self.study.section, self.draft(rise)
        if section.shape == "rectangle":
            return section.beam / 2, draft
        if section.shape == "circle":
            return equal_area(section.diameter, draft)
        raise StudyError("theory long waves needs a rectangle or a circle; section.shape is 'outline'")

    def mirrored(self, wetted):
        """The `Wetted`, if it is its own mirror image.  Raises StudyError."""
        if not wetted.symmetric:
            raise StudyError("section is not its own mirror image in y = 0; needed where it moves or loses head")
        return wetted

    def _check_stretch(self):
        """Raise StudyError where the pretension would draw the lines out to twice their length."""
        lines = self.study.lines
        if lines is None or lines.axial_stiffness_kN is None:
            return
        most = max(self.pretension(rise) for _, rise in self.levels) * lines.spacing / KN
        if 2 * most > lines.axial_stiffness_kN:
            raise StudyError(
                f"lines.axial_stiffness_kN is {lines.axial_stiffness_kN:g} and the pretension up to {most:.4g} kN of a "
                "line: more than half of its length would be stretch; give a stiffer line or a heavier body"
            )

    def beside(self):
        """A line where the lines' upper ends are beside the body, or nothing"""
        lines = self.study.lines
        if lines is None:
            return
        away = self.outline.distance(complex(lines.attachment, self.outline.bottom + lines.attachment_height))
        if away > CLEAR * self.line:
            yield (
                f"lines.attachment is {lines.attachment:g} m and attachment_height {lines.attachment_height:g} m, "
                f"{away:.3g} m beside the body: lines are taken as held by arms there"
            )

    def _check_clear(self):
        """Raise StudyError where a line would pass through the body."""
        lines = self.study.lines
        height = self.outline.bottom + lines.attachment_height
        down = self.line * np.exp(-1j * self.angle)
        ways = [(side * lines.attachment + 1j * height, complex(side * down.real, down.imag)) for side in (1, -1)]
        if any(self.outline.meets(top + CLEAR * way, top + way) for top, way in ways):
            raise StudyError(
                f"lines.angle_deg is {lines.angle_deg:g}: a line from y = {lines.attachment:g} m, "
                f"{lines.attachment_height:g} m above the lowest point, passes through the body; allowed: lines that "
                "leave it at once; move the attachment"
            )


def outline_of(points):
    """`Outline` of rows y, z and bulge that end where they began.  Raises OutlineError."""
    rows = np.array([[*point, 0.0][:3] for point in points])
    places = rows[:, 0] + 1j * rows[:, 1]
    if len(rows) < 3 or places[0] != places[-1]:
        gap = f"the last point is {abs(places[-1] - places[0]):.3g} m from the first" if len(rows) else "there is none"
        raise OutlineError(f"the outline leaks: {gap}; allowed: points that end where they began")
    return closed(places[:-1], rows[:-1, 2])
