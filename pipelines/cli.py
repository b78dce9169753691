"""The `hakobune` command.  Heavy imports happen inside the commands, so that help appears at once."""

from __future__ import annotations

import os
import re
import signal
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import App, CycloptsError, MissingArgumentError, Parameter

from hakobune.bem import __version__
from hakobune.mooring.criteria.failing import fails

from .common.interrupt import interrupted
from .printing import timing
from .printing.console import new_console, tables_as, taken
from .printing.verdict import tell
from .scene.flags import RunFlags, SceneFlags, overlaid, tables_of_bodies

OWN_FORMS = ("keys",)  # commands that write their own JSON
# commands of other rooms as module:function, each read when it is asked for: to read all takes 0.03 s
ELSEWHERE = (
    "moor.command:moor",
    "sea.command:sea",
    "response.command:response",
    "qtf.command:qtf",
    "downtime.command:downtime",
    "sections.command:sections",
    "validation.comparisons.command:compare",
    "validation.bench.command:bench",
    "validation.stress.command:stress",
    "waves.command:waves",
    "lines.flags:line",
    "lines.flags:lines",
    "line_dynamics.command:line_dynamics",
    "simulate.flags:simulate",
    "films.flags:animate",
    "site.command:site",
    "design.command:design",
    "single_point.command:single_point",
    "validation.series.flags:series",
    "breakwater.command:breakwater",
    "fender.command:fender",
    "members.command:members",
    "passing.command:passing",
    "berth.command:berth",
    "damping.command:damping",
    "earthquake.command:earthquake",
    "doctor:doctor",
    "exchange.flags:export",
    "exchange.flags:import_",
    "exchange.flags:body_",
    "keys.command:keys",
    "keys.command:new",
)
app = App(
    name="hakobune",
    help="From a floating body's dimensions to the tension in its last mooring line.\n\n"
    "Any command prints its tables as CSV with --csv and as JSON with --json;\n"
    "with --timing it shows on stderr the time of each phase.",
    version=__version__,
    result_action="return_value",
    suppress_keyboard_interrupt=False,
    help_format="plaintext",  # without the 0.1 s that the import of a Markdown reader takes
)
app.register_install_completion_command(help="Install completion of commands and flags for bash, zsh or fish.")
Size = Annotated[float | None, Parameter(allow_leading_hyphen=True)]
SceneFile = Annotated[Path | None, Parameter(help="scene file (TOML); flags replace its keys")]


@app.command
def box(
    scene: SceneFile = None,
    /,
    *,
    length: Annotated[Size, Parameter(help="m")] = None,
    beam: Annotated[Size, Parameter(help="m")] = None,
    draft: Annotated[Size, Parameter(help="m")] = None,
    flags: SceneFlags = SceneFlags(),  # noqa: B008 - a frozen value
    run: RunFlags = RunFlags(),  # noqa: B008
):
    """Compute radiation, diffraction, motions and drift of a box; sizes in m.

    A second call with the same output continues where the first stopped, or adds what is new.
    """
    return _solve(scene, {"shape": "box", "length": length, "beam": beam, "draft": draft}, flags, run)


@app.command
def buoy(
    scene: SceneFile = None,
    /,
    *,
    radius: Annotated[Size, Parameter(help="m")] = None,
    draft: Annotated[Size, Parameter(help="m")] = None,
    flags: SceneFlags = SceneFlags(),  # noqa: B008
    run: RunFlags = RunFlags(),  # noqa: B008
):
    """Compute radiation, diffraction, motions and drift of a vertical circular cylinder; sizes in m."""
    return _solve(scene, {"shape": "buoy", "radius": radius, "draft": draft}, flags, run)


@app.command
def ship(
    scene: SceneFile = None,
    /,
    *,
    length: Annotated[Size, Parameter(help="m")] = None,
    beam: Annotated[Size, Parameter(help="m")] = None,
    draft: Annotated[Size, Parameter(help="m")] = None,
    block: Annotated[float | None, Parameter(help="block coefficient", allow_leading_hyphen=True)] = None,
    bow: Annotated[float | None, Parameter(help="fullness of the bow waterplane", allow_leading_hyphen=True)] = None,
    stern: Annotated[
        float | None, Parameter(help="fullness of the stern waterplane", allow_leading_hyphen=True)
    ] = None,
    waterplane: Annotated[float | None, Parameter(help="waterplane coefficient C_WP, instead of bow and stern")] = None,
    flags: SceneFlags = SceneFlags(),  # noqa: B008
    run: RunFlags = RunFlags(),  # noqa: B008
):
    """Compute radiation, diffraction, motions and drift of a ship by its block coefficient; sizes in m.

    The ship has a flat bottom, a bilge, and a pointed bow and stern; x points to the bow.
    """
    form = {"block": block, "bow": bow, "stern": stern, "waterplane": waterplane}
    return _solve(scene, {"shape": "ship", "length": length, "beam": beam, "draft": draft, **form}, flags, run)


@app.command
def solve(
    scene: SceneFile = None,
    /,
    *,
    mesh: Annotated[str | None, Parameter(help="mesh file: .gdf .msh .vtu .pnl …")] = None,
    flags: SceneFlags = SceneFlags(),  # noqa: B008
    run: RunFlags = RunFlags(),  # noqa: B008
):
    """Compute radiation, diffraction, motions and drift of the body of a scene file or of a mesh file."""
    if scene is None and mesh is None:
        raise ValueError("nothing to solve; give a scene file or --mesh file")
    return _solve(scene, {} if mesh is None else {"shape": "mesh", "file": mesh}, flags, run)


@app.command
def look(
    file: Annotated[Path, Parameter(help="database, scene or mesh file")],
    /,
    *,
    plot: Annotated[Path | None, Parameter(help="write a picture instead of opening a window")] = None,
    page: Annotated[Path | None, Parameter(help="write a page (.html) in which a browser turns the mesh")] = None,
    field: Annotated[
        str | None, Parameter(help="quantity that colours the panels: area, size, aspect or pressure")
    ] = None,
    omega: Annotated[float | None, Parameter(help="frequency of the pressure, rad/s; shows the nearest stored")] = None,
    heading: Annotated[Size, Parameter(help="heading of the pressure, degrees; one that is stored")] = None,
):
    """Show the mesh of a database, a scene or a mesh file, coloured by a field."""
    from .view.looking import look

    return look(file, plot, field, omega, heading, page)


@app.command
def mesh(
    file: Annotated[Path, Parameter(help="mesh file")],
    /,
    *,
    output: Annotated[Path, Parameter(help=".gdf, .pnl, .nemoh, .dat, .msh or .vtu")],
    scale: Annotated[str, Parameter(help="scale by a factor, or by three along x,y,z")] = "1",
    heal: Annotated[float, Parameter(help="merge points closer than this, m", show_default=False)] = 0.0,
    turn: Annotated[
        str, Parameter(help="turn by degrees about z, or x,y,z in this order", allow_leading_hyphen=True)
    ] = "0",
    move: Annotated[str, Parameter(help="move by x,y,z, m", allow_leading_hyphen=True)] = "0,0,0",
    flip: Annotated[bool, Parameter(help="reverse the normals, or turn mixed ones outward", negative="")] = False,
    mirror: Annotated[str, Parameter(help="add the mirror images in these planes: x, y or xy")] = "",
    clip: Annotated[bool, Parameter(help="cut the hull at z = 0 and keep the part below", negative="")] = False,
    outer: Annotated[
        bool, Parameter(help="leave out copies, inner walls, folds and parts that no water reaches", negative="")
    ] = False,
    fold: Annotated[bool, Parameter(help="keep a half or quarter of a symmetric hull", negative="")] = False,
):
    """Change a mesh file, in the order of the flags below, and write it in the format of the new name.

    hakobune mesh hull.stl --scale 0.001 --move 0,0,-4 --clip --output hull.gdf
    """
    from .view.changing import change

    return change(file, output, scale, turn, move, flip, mirror, clip, outer, fold, heal)


@app.command
def plot(
    file: Annotated[Path, Parameter(help="database, .h5")],
    /,
    *,
    output: Annotated[Path | None, Parameter(help=".png, .svg or .pdf")] = None,
):
    """Draw coefficients, excitation, motions and drift of a database, by default to a .png beside it.

    With several bodies there is one picture for each, with the name of the body added. Bodies with beams have one
    picture of their bending.
    """
    from hakobune.bem.bodies.one_of_several import each_body
    from hakobune.bem.database import open_database

    from .common.gaps import gaps_of
    from .common.picture import PLOTS, check_picture
    from .view.deflection import beams_of, deflections
    from .view.plots import plot

    output = output or file.with_suffix(".png")
    check_picture(output, PLOTS)
    db = open_database(file)
    for one in each_body(db):
        picture = output.with_stem(f"{output.stem}_{one.name}") if db.bodies else output
        plot(one, picture)
        print(picture)
    if beams_of(db):
        picture = output.with_stem(f"{output.stem}_bending")
        deflections(db, picture)
        print(picture)
    return tell(map(fails, gaps_of(db).words()))


@app.command
def check(
    file: Annotated[Path, Parameter(help="database, or result of a study")],
    /,
    *,
    repair: Annotated[bool, Parameter(negative=(), help="mark damaged frequencies as unsolved")] = False,
):
    """Check a database by the laws of physics, and its mesh; or the checksum of a result (.h5, .csv).

    Status 1 if a check fails.
    """
    from .checking import check

    return check(file, new_console(), repair)


@app.command
def sweep(
    study: Annotated[Path, Parameter(help="sweep: a study and the keys to vary (TOML)")],
    /,
    *,
    output: Annotated[Path | None, Parameter(help="file of all cases, .h5 [beside the sweep]")] = None,
    executor: Annotated[
        str, Parameter(help="where cases run: local, processes:N, dask:N, dask://host:port, slurm:N")
    ] = "local",
    fresh: Annotated[bool, Parameter(help="replace an existing file", negative="")] = False,
    plot: Annotated[
        Path | None, Parameter(help="picture of the results over the first key: .png, .svg or .pdf")
    ] = None,
):
    """Run many cases of a study over its keys; a second call continues where the first stopped.

    hakobune new sweep
    """
    from .sweep.command import sweep

    return sweep(study, output, executor, fresh, plot)


for place in ELSEWHERE:
    app.command(f"{__package__}.{place}", name=place.partition(":")[2].strip("_").replace("_", "-"))


def main(arguments=None):
    """Run a command; every fault is one line on stderr.  Returns the exit status."""
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    command = arguments[0] if arguments and arguments[0].replace("-", "").isalpha() and arguments[0][0] != "-" else ""
    name = f"hakobune {command}".strip()
    timed = timing.FLAG in arguments  # requested for this command itself, not for a command inside a sweep
    if timed:
        timing.begin()
        arguments = [word for word in arguments if word != timing.FLAG]
    try:
        if not command:  # the list of all has their first lines
            for one in app:
                _ = app[one]
        arguments, form = (arguments, None) if command in OWN_FORMS else taken(arguments)
        with tables_as(form):
            status = app(arguments, exit_on_error=False, print_error=False) or 0
        sys.stdout.flush()
        return status
    except BrokenPipeError:  # the reader of the output has closed, so that no message is needed
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + signal.SIGPIPE
    except MissingArgumentError as error:
        print(f"{name}: {_missing(error)}", file=sys.stderr)
        return 2
    except (CycloptsError, ValueError, OSError, ImportError) as error:
        print(f"{name}: {_one_line(error, command)}", file=sys.stderr)
        return 2
    except MemoryError as error:
        reason = str(error) or "the request exceeds the free memory"
        print(f"{name}: there is not enough memory: {reason}", file=sys.stderr)
        return 2
    except KeyboardInterrupt as stop:
        print(f"{name}: {str(stop) or interrupted(command, arguments)}", file=sys.stderr)
        return 130
    finally:
        for line in timing.told() if timed else ():
            print(line, file=sys.stderr)


def _missing(error):
    """A flag or an argument that is not given, or given without its value, with its line of help"""
    what = "needs a value" if error.keyword or error.argument.tokens else "is missing"
    return f"{error.argument.name} {what}: {error.argument.parameter.help}"


def _one_line(error, command=""):
    """Its message, with a file of one long word shortened; an unknown flag is told with ours that is meant"""
    text = " ".join(str(error).split())
    if (flag := re.match(r"Unknown option: --([\w-]+)", text)) and command in app:
        return f"Unknown option: --{flag[1]}.{_instead(flag[1].lower(), command)}"
    return re.sub(r"\S{500,}", lambda word: f"{word[0][:100]}…", text)[:5000]


def _instead(word, command):
    """The flags of a command that a word of other programs stands for, or the one that is spelled like it"""
    from difflib import get_close_matches

    from .keys.words import OTHER_NAMES

    known = {name for one in app[command].assemble_argument_collection() for name in one.names if name[:2] == "--"}
    flags = ["--" + key.replace("_", "-") for key, others in OTHER_NAMES.items() if word in others.split()]
    if ours := [flag for flag in flags if flag in known]:
        return f" It is {' or '.join(ours)} here."
    near = get_close_matches(word, [name[2:] for name in sorted(known)], n=1)  # without dashes, that all have
    return f" Did you mean --{near[0]}?" if near else ""


def _solve(file, body, flags, run):
    from .scene.scene import SceneError, make_scene, read_scene

    raw = read_scene(file) if file else {}
    shape = tables_of_bodies(raw)[0].get("shape", "box")
    if file and body.get("shape") in ("box", "buoy", "ship") and shape != body["shape"]:
        raise SceneError(f"{file} has a body of shape {shape!r}; allowed here: {body['shape']}, or use solve")
    name = file.stem if file else body["shape"]
    raw = overlaid(raw, flags, {key: value for key, value in body.items() if value is not None})
    if run.mesh_only:
        return _write_mesh(raw, run.output or Path(f"{name}.msh"))
    scene = make_scene(raw)
    return _run(scene, run.output or Path(f"{name}.h5"), run)


def _run(scene, output, flags):
    from hakobune.bem.database import open_database

    from .executors.choice import executor_of

    console, executor = new_console(), executor_of(flags.executor)
    from .solve import run
    from .solve.report import gives_panels, print_outcome

    try:
        outcome = run.solve(scene, output, fresh=flags.fresh, executor=executor, console=console)
    finally:
        executor.shutdown(wait=False, cancel_futures=True)
    with timing.phase("report"):
        return print_outcome(console, outcome, open_database(output), gives_panels(scene))


def _write_mesh(raw, output):
    from hakobune.bem.database.file import check_place
    from hakobune.meshing.files import write_mesh

    from .scene.scene import make_scene
    from .solve.hull import make_hull

    # a mesh alone needs neither water nor waves; deep water and long waves require no panels
    raw["water"].setdefault("depth", float("inf"))
    if not set(raw["waves"]) - {"headings_deg"}:
        raw["waves"]["periods"] = [1000.0]
    scene = make_scene(raw)
    check_place(output)
    hull = make_hull(scene)
    write_mesh(hull.mesh, output)
    print(f"{output}: {hull.mesh!r}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
