"""The pages of theory: what modules say of their equations and sources, in an order to read them in."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
ENTRY = re.compile(r"^([^\s.:;=`][^.:;=`]{0,30}?) : (\S.*)$")
CHAPTERS = {
    "Waves": ("bem/__init__.py", "bem/waves.py"),
    "Green functions": ("bem/green/finite_depth.py", "bem/green/deep_water.py", "bem/green/rankine.py"),
    "Radiation and diffraction by panels": (
        "bem/panels/influence.py",
        "bem/panels/irregular_frequencies.py",
        "bem/panels/band/low_rank_waves.py",
        "bem/panels/axisymmetric.py",
    ),
    "Radiation and diffraction of vertical sides": (
        "bem/depth_modes/gap.py",
        "bem/contour/matching.py",
        "bem/sections/coefficients.py",
    ),
    "Far field, drift, motions": (
        "bem/kochin.py",
        "bem/drift.py",
        "bem/methods/near_field.py",
        "bem/motions.py",
        "bem/viscous.py",
        "bem/wave_field/sources.py",
    ),
    "Second order": (
        "bem/second_order/quadratic_forces.py",
        "bem/second_order/bound_waves.py",
        "bem/second_order/long_wave_forces.py",
        "bem/second_order/body_forces.py",
        "bem/second_order/surface_forces.py",
    ),
    "From frequency to time": (
        "bem/time_domain/whole_axis.py",
        "bem/time_domain/memory.py",
        "bem/time_domain/passive_fit.py",
        "bem/time_domain/moving_poles.py",
        "bem/time_domain/sensitivity.py",
    ),
    "Seas, wind, current": (
        "mooring/environment/spectra.py",
        "mooring/environment/spreading.py",
        "mooring/environment/gusts.py",
        "mooring/seas/shallow.py",
        "mooring/seas/breaking.py",
        "mooring/environment/crossings.py",
    ),
    "Response of a free body": (
        "mooring/response/slow_drift.py",
        "mooring/response/wave_drift_damping.py",
        "mooring/on_current/waves.py",
        "mooring/on_current/body.py",
        "mooring/response/extremes.py",
        "mooring/response/viscous.py",
    ),
    "Lines": (
        "mooring/lines/catenary/suspended.py",
        "mooring/lines/catenary/flat_bed.py",
        "mooring/lines/catenary/sloping_bed.py",
        "mooring/lines/multi_segment/equations.py",
        "mooring/lines/multi_segment/friction.py",
        "mooring/lines/system/equilibrium.py",
        "mooring/lines/dynamics/lumped/forces.py",
        "mooring/lines/dynamics/lumped/esdirk.py",
    ),
    "A moored body in time": (
        "mooring/motion/equation.py",
        "mooring/motion/integrator.py",
        "mooring/motion/wave_loads.py",
        "mooring/motion/contact_loads.py",
        "mooring/motion/extremes.py",
        "mooring/studies/long_period.py",
    ),
    "Fenders, berthing, dolphins": (
        "mooring/fenders/fender.py",
        "mooring/fenders/hysteresis.py",
        "mooring/berthing/energy.py",
        "mooring/berthing/two_springs.py",
        "mooring/berthing/memory.py",
        "mooring/dolphins/linearised.py",
        "mooring/dolphins/earthquake.py",
    ),
    "A single point": (
        "mooring/single_point/criterion.py",
        "mooring/single_point/equilibria.py",
        "mooring/single_point/slewing.py",
    ),
    "Breakwaters": (
        "mooring/breakwater/long_waves.py",
        "mooring/breakwater/taut.py",
        "mooring/breakwater/transmission.py",
    ),
    "Sites, strength, life": ("mooring/site/extremes.py", "mooring/site/contours.py", "mooring/criteria/fatigue.py"),
}


def slug(title):
    """The name of a chapter in the address of its page"""
    return re.sub(r"\W+", "-", title.lower())


def contents():
    """Markdown of the page that lists the chapters"""
    links = "\n".join(f"- [{title}](theory-{slug(title)}.md)" for title in CHAPTERS)
    return (
        "# Theory\n\nEquations, signs and sources, in the words of the modules that compute them. Symbols are those of "
        f"the sources. The page of [conventions](conventions.md) defines signs and axes.\n\n{links}\n"
    )


def chapter(title):
    """Markdown of the page of a chapter"""
    parts = [f"# Theory: {title}"]
    for place in CHAPTERS[title]:
        parts.append(f"## {Path(place).stem.replace('_', ' ').replace('  init  ', '').strip() or 'conventions'}")
        parts.append(f"{said(ROOT / place)}\n\n*From `{place}`.*")
    return "\n\n".join(parts) + "\n"


def said(path):
    """The docstring of a module as Markdown: entries `name : text` as a list, other indented lines as they are"""
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8")))
    out, entry = [], False
    for line in text.splitlines():
        if found := ENTRY.match(line):
            out += [] if entry else [""]
            out.append(f"- *{found[1]}*: {found[2]}")
        elif entry and line.startswith("    "):
            out.append(f"  {line.strip()}")
            continue
        elif line.strip() and out and out[-1].strip() and (entry or line[:4] == "    " != out[-1][:4]):
            out += ["", line]  # or it would run into what stands before
        else:
            out.append(line)
        entry = bool(found)
    return "\n".join(out)
