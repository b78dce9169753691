"""`hakobune breakwater`: a floating breakwater from the waves to its anchors."""
