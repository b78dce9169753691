"""`hakobune earthquake`: a floating body between dolphins while the ground moves."""
