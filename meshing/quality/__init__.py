"""What is wrong with a mesh, or makes it inaccurate: findings, not exceptions.

findings  every finding of a hull and its lid; overlap  parts that lie in each other; seams  panels side to side
"""

from .findings import Finding, findings, lid_findings

__all__ = ["Finding", "findings", "lid_findings"]
