"""Theorems that decide an arm from the shape of its axes."""
