"""`hakobune waves`: the waves around a body."""
