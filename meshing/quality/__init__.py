"""Errors of a mesh, and causes of inaccuracy: findings, not exceptions.

findings : all findings on a hull and its lid; overlap : parts inside each other
seams : panels side by side without common corners; outward : normals turned to the water
"""

from .findings import Finding, findings, lid_findings

__all__ = ["Finding", "findings", "lid_findings"]
