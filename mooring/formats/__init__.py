"""Files of other mooring codes: MoorDyn input, MoorPy YAML, and results under MoorDyn's names."""
