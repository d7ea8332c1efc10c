"""A robot and its polynomial map: chains, D-H tables, URDF, reductions."""
