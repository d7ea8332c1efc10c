"""The polynomial map of a robot, its postures, and the theorems about its axes."""
