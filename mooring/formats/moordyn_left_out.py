"""Contents of a MoorDyn file that lines at rest on a flat bed in still water do not support: one text for each kind.

Settings of a run in time (step, scheme, relaxation, outputs, stiffness and damping of the bed, drag, added mass,
axial damping) have no effect at rest and are not reported. Bending stiffness is reported for moving lines.  MoorDyn
2.7 documentation, "Inputs" and "Features".
"""

from math import isfinite

from .moordyn_ropes import is_syrope
from .moordyn_rows import FREE

# OPTIONS of the file in lower case, with the effect that a value other than 0 switches on
BROUGHT_IN = {
    "wavekin": "waves",
    "waterkin": "waves and currents",
    "currents": "currents",
    "seafloorfile": "the bathymetry",
    "bathfile": "the bathymetry",
}
# settings of a run in time, and those supported by the System, separated by blanks
IN_TIME = (
    " dtm dt cfl tscheme kbot kb cbot cb dtic icdt tmaxic ictmax cdscaleic icdfac threshic icthresh icgendynamic "
    "gendynamicic fileic icfile dtwave unifycurrentgrid writelog writeunits dtout disableoutput disableouttime "
    "fricdamp statdynfricscale mu_ka mc cv inertialf inertialf_ramp outswitch "
)
UNDERSTOOD = " wtrdpth depth waterdepth wtrdnsty rho rhow wtrdens g gravity grav frictioncoefficient mu_kt friccoeff "


def left_out(file, moves=False):
    """[text, …], one for each kind of content of a MoorDynFile that its System does not support; moves : whether
    lines move
    """
    said = [*_of_types(file, moves), *_of_options(file)]
    joints = [row.id for row in file.rods if (row.xa, row.ya, row.za) == (row.xb, row.yb, row.zb)]
    bent = [row.name for row in file.rod_types if file.rods and file.lines]
    heeled = [row.id for row in file.bodies if row.attachment.lower() in FREE and (row.roll0 or row.pitch0)]
    for names, what in (
        ([row.id for row in file.failures], "failure {} of lines is left out: lines do not break in the statics"),
        (bent, "bending and end forces of rods of type {} are not included"),
        (
            heeled,
            "free body {} starts heeled (r0, p0): the heel is not used; the search for its equilibrium starts "
            "from upright",
        ),
        (joints, "rod {} has no length: the bending moment that it transmits is not included"),
    ):
        if names:
            said.append(what.format(", ".join(names)))
    if file.syrope and not any(is_syrope(row) for row in file.line_types):
        said.append("section SYROPE IC is not used: no line type is a Syrope rope")
    for key, title in (("control", "CONTROL"), ("external", "EXTERNAL LOADS")):
        if getattr(file, key):
            said.append(f"section {title} is not used")
    return said


def _of_types(file, moves):
    rows = file.line_types
    bent = [row.name for row in rows if not (_number(row.EI) if moves else _nought(row.EI))]
    for names, what in (
        (bent, "bending stiffness EI of {} is not included" + (", a table" if moves else "")),
        (
            [row.name for row in rows if "|" in row.EA and not is_syrope(row)],
            "the dynamic stiffness (EA a|b) of {} is not included; the static stiffness is used",
        ),
        (
            [row.name for row in rows if is_syrope(row)],
            "the fast stiffness of the Syrope rope {} is not included, since its slow working curve applies at rest; "
            "Tmean0 is not used, since the tension follows from the equilibrium",
        ),
        ([row.name for row in rows if row.Cl], "vortex-induced vibration (Cl) of {} is not included"),
    ):
        if names:
            yield what.format(", ".join(names))


def _of_options(file):
    unknown = []
    for name, value in file.options.items():
        key = name.lower()
        if key in BROUGHT_IN:
            if not _nought(value):
                yield f"{BROUGHT_IN[key]} ({name} {value}) is left out: the water is still and the bed is flat"
        elif f" {key} " not in IN_TIME + UNDERSTOOD:
            unknown.append(name)
    if unknown:
        yield f"option {', '.join(unknown)} is unknown and ignored"


def _number(text):
    """Whether a moving line can have this bending stiffness; False for a table"""
    try:
        return isfinite(float(text))
    except ValueError:
        return _nought(text)


def _nought(text):
    try:
        return float(text) == 0
    except ValueError:
        return text.lower() in ("none", "-")
