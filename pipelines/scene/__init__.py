"""Scenes: typed TOML, products, methods."""
