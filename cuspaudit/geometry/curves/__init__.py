"""Curves: their parametrization, their sections and their branches."""
