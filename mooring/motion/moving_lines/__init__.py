"""Mooring lines with their own equations of motion, whose fairleads move with a body in time."""
