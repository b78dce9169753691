"""Difference forces of pairs of waves: computed, stored, drawn."""
