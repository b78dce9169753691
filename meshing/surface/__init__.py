"""Panels on the water outside hulls"""
