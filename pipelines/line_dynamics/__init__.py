"""`hakobune line-dynamics`: one line whose fairlead moves."""
