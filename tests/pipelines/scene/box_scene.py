"""The scene of a box that tests of scenes change."""

SCENE = """
tolerance = 0.01

[water]
depth = 20.0

[[bodies]]
shape = "box"
length = 100.0
beam = 50.0
draft = 10.0
gyration = [15.0, 29.0, 32.0]

[waves]
omegas = [0.4, 0.8]
headings_deg = [0, 45]
"""
