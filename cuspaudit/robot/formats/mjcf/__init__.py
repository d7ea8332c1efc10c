"""MJCF, the models of MuJoCo: bodies, joints and defaults of one file, as text."""
