"""A body in water set up for one of the methods, and what is asked of any of them."""
