"""Flexible bodies of a scene."""
