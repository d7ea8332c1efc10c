"""The postures of a six-joint arm at a pose, in floats and exactly."""
