"""A floating breakwater: from its section and lines to the transmitted waves, tensions over the tide, anchors and best
designs."""
