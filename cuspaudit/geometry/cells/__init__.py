"""Open cells of the plane of values, their contacts, and ways inside them."""
