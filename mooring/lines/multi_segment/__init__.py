"""One line of many segments with sinkers and buoys over an uneven bed with friction."""
