"""Hulls drawn as curved patches and converted to flat panels"""
