"""Eigenfunctions over the depth and the functions that carry the flow through a keel gap."""
