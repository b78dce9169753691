"""A mooring line as nodes joined by straight elastic elements: forces, implicit steps, static start.

Public interface: `mooring.lines.dynamics.simulation`.  This folder contains the code that `simulation` compiles.
"""
