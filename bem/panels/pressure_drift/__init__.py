"""Mean drift from the pressure on the panels of a hull, with the flow at its edges."""
