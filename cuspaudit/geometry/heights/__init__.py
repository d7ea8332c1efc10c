"""A height on a variety: its critical points, and the proved ways between them."""
