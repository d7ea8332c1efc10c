"""Parallel robots: legs, platform and actuated joints, to a variety and a map.

A mechanism is read from a file (``reading``), written as equations of its loops
(``equations``), and drawn at a point of them (``drawing``).
"""
