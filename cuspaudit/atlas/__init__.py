"""Robots as a static site: one table, and a page and a certificate an arm."""
