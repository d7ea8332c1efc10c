"""The verdict within joint limits."""
