"""Families of robots: parameters, the sweep over them, its rows and its pictures."""
