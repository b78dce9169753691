"""Panels on the water surface outside hulls"""
