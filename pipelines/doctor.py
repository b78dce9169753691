"""`hakobune doctor`: the environment of the command: libraries, threads, memory, the folder of compiled kernels."""

from __future__ import annotations

import os
import platform
import sysconfig
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

import hakobune
from hakobune.mooring.criteria.failing import fails

from .executors.beside import processors
from .printing.verdict import tell

NEEDED = ("numpy", "scipy", "numba", "h5py", "gmsh", "meshio", "pyvista", "matplotlib", "msgspec", "cyclopts", "rich")
OLD = {"meshing": "gmsh_session.py", "bem": "stored_laws.py", "mooring": "catenary.py", "pipelines": "start.py"}
OPTIONAL = {"xarray": "reads databases with labelled axes"}


def doctor(
    *,
    compile: Annotated[bool, Parameter(help="compile the kernels of all studies now", negative="")] = False,
):
    """Show what is installed and what is missing; status 1 if a command cannot work.

    hakobune doctor
    """
    from .common.bounds import available_memory

    amiss = []
    print(
        f"hakobune {_version('hakobune') or 'not installed'}, Python {platform.python_version()}, {platform.platform()}"
    )
    print(f"  {'from':<12}{Path(hakobune.__file__).parent}")
    for name in NEEDED:
        found = _version(name)
        print(f"  {name:<12}{found or 'missing'}")
        if found is None:
            amiss.append(f"{name} is missing: pip install {name}")
    for name, use in OPTIONAL.items():
        print(f"  {name:<12}{_version(name) or 'missing'}   optional, {use}")
    amiss += [said for said in (_gmsh(), _cache(), _left_over()) if said]
    print(f"  {'memory':<12}{available_memory() / 1e9:.1f} GB free")
    print(f"  {'processors':<12}{processors()}")
    if compile and not amiss:
        from .compiling import compile_all

        amiss += compile_all()
    if not amiss:
        print("nothing is amiss")
    if _version("rich") is None:  # tell() needs rich
        print("\n".join(map(fails, amiss)))
        return 1
    return tell(map(fails, amiss))


def _version(name):
    from importlib import metadata

    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def _left_over():
    """Folders in site-packages left by installations that predate the `hakobune` package, "" for none.

    Folders of these names without our modules belong to other projects.
    """
    place = Path(sysconfig.get_path("purelib"))
    ours = [name for name, module in OLD.items() if (place / name / module).is_file()]
    if not ours:
        return ""
    return f"{', '.join(ours)} in {place} are from an older installation; remove these folders"


def _gmsh():
    """The import of gmsh also loads its shared libraries"""
    from hakobune.meshing.gmsh_session import session

    try:
        with session():
            pass
    except (ImportError, OSError) as error:
        return f"gmsh cannot be loaded, so that no meshes can be made: {' '.join(str(error).split())}"
    return None


def _cache():
    from hakobune.bem.kernels import jit

    folder = jit.cache_folder(jit.__file__, jit.ROOT).parent
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) if folder.is_dir() else 0
    print(f"  {'kernels':<12}{folder}, {size / 1e6:.0f} MB compiled (HAKOBUNE_CACHE moves it)")
    place = next(path for path in (folder, *folder.parents) if path.exists())
    if not os.access(place, os.W_OK):
        return (
            f"{place} cannot be written, so kernels are compiled at every start; set HAKOBUNE_CACHE to a writable "
            f"folder"
        )
    return ""
