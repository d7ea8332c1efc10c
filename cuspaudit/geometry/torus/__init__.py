"""Trigonometric functions on a torus: components, covers, critical points, ways."""
