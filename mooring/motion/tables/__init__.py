"""Tables of forces over an angle or over time, and the force of the water on a slewing hull."""
