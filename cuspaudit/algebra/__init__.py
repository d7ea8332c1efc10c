"""Exact arithmetic over Q: rings, systems, elimination, real roots."""
