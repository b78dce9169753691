"""Hulls drawn by curved patches, made of flat panels"""
