"""The folders at the top are installed below the package `hakobune`."""

from setuptools import find_packages, setup

FOLDERS = ("meshing", "bem", "mooring", "pipelines")
found = find_packages(include=[pattern for name in FOLDERS for pattern in (name, f"{name}.*")])
setup(
    packages=["hakobune", *(f"hakobune.{name}" for name in found)],
    package_dir={"hakobune": "hakobune", **{f"hakobune.{name}": name for name in FOLDERS}},
)
