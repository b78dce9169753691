"""Mooring lines in detail: static lines of many parts, the dynamics of lines, and the loads on lines."""
