"""`hakobune members`: water and wind on the slender members of a structure."""
