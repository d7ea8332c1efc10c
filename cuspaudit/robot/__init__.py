"""A robot: its chain, its task, its numbers, and the files it is read from."""
