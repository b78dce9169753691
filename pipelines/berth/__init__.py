"""`hakobune berth`."""
