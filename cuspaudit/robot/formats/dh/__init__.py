"""D-H tables: read, written, and fitted to a chain."""
