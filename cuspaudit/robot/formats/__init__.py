"""The formats a robot is read from, one package each."""
