"""Files of other mooring codes: MoorDyn input, MoorPy YAML, and results under the names MoorDyn's users know."""
