"""Modules of the package ssik: one arm's constants each, written by a program."""
