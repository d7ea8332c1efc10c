"""The proof for every robot that a tolerance allows."""
