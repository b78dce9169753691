"""Bodies of a scene that bend."""
