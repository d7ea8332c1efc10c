"""What a Python program calls: the commands as functions, their results as objects."""
