"""`hakobune line` and `hakobune lines`: one mooring line, and systems of mooring lines."""
