"""The proof by a theorem whose relations are tested exactly."""
