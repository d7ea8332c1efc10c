"""The ways to a verdict, one file each."""
