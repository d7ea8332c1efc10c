"""Decide, with a proof, whether a robot arm is cuspidal."""

__version__ = "0.1.0"
