"""A floating breakwater from its section and lines to what passes it, tensions over the tide, anchors, best designs."""
