"""An arm written by its invariants: read from rounded numbers, no relation lost."""
