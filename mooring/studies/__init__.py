"""Studies of a moored body, each from its lines, loads and wave database."""
