"""Runs of a tool path, followed and proved."""
