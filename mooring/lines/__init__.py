"""Mooring lines in detail: static lines of many parts, their dynamics, and the loads on them."""
