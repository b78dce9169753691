"""Mooring lines that move by equations of their own while a body in time moves their fairleads."""
