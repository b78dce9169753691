"""Databases of several bodies: what is of one of them."""
