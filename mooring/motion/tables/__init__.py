"""Tables from which forces are read, over an angle or over time, and the water on a slewing hull."""
