"""The animated scene: the arm, its motion, the camera."""
