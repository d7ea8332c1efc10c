"""The proof by all pairs of postures of three joints."""
