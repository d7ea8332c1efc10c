"""Figures: curves and planes of arms, the phases of a family."""
