"""Databases of several bodies: access to one of the bodies."""
