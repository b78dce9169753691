"""Eigenfunctions over the depth and basis functions of the velocity in a keel gap."""
