"""Mean drift from the pressure on the panels of a hull, with the singular flow at its edges."""
