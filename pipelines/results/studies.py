"""The study functions of the program: the module of each, imported on its first call."""

from importlib import import_module

MODULES = {
    "berth": "pipelines.berth.result",
    "breakwater": "pipelines.breakwater.result",
    "damping": "pipelines.damping.result",
    "design": "pipelines.design.result",
    "downtime": "pipelines.downtime.result",
    "earthquake": "pipelines.earthquake.result",
    "fender": "pipelines.fender.result",
    "line": "pipelines.lines.line_result",
    "line_dynamics": "pipelines.line_dynamics.result",
    "lines": "pipelines.lines.lines_result",
    "members": "pipelines.members.result",
    "moor": "pipelines.moor.result",
    "passing": "pipelines.passing.result",
    "qtf": "pipelines.qtf.result",
    "response": "pipelines.response.result",
    "sea": "pipelines.sea.result",
    "sections": "pipelines.sections.result",
    "simulate": "pipelines.simulate.result",
    "single_point": "pipelines.single_point.result",
    "site": "pipelines.site.result",
    "solve": "pipelines.solve.result",
    "sweep": "pipelines.sweep.result",
    "waves": "pipelines.waves.result",
}


def function_of(command):
    """The study function of a command"""
    name = command.replace("-", "_")
    return getattr(import_module(f"hakobune.{MODULES[name]}"), name)
