"""The same routines for maps from a product of two circles or lines to the plane.

An arm of three joints is decided here, in milliseconds: fibers and roadmap come from
resultants in one variable. ``geometry`` has them for any variety and map.
"""
