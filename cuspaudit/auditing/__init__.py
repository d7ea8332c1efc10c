"""The audit of one robot: decision, cross-check, report."""
