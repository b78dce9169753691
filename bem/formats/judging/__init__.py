"""Sets of other programs held against the hull, the water and laws of their own before they are believed."""
