"""Lines between bodies, anchors and free points as one system: forces, equilibrium, results at rest."""
