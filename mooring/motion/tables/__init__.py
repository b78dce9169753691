"""What forces are read from: tables over an angle or over time, and the water on a hull that slews."""
