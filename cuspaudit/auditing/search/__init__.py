"""Searches in floats for couples, paths, aspects; what they find is proved after."""
