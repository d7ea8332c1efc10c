"""The proof over the values of a locked joint."""
