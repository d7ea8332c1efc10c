"""The generic fiber of a map, proposed and then proved."""
