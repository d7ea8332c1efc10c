"""A path below lifted to a variety, in boxes that prove it."""
