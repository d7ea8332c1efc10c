"""Sets of points: the solutions of systems that have finitely many, or a curve."""
