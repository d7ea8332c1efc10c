"""Nearest structures: how far an arm is from one that a theorem decides."""
