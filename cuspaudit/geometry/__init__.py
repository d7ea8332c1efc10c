"""The routines of the paper, one file each; nothing here knows a robot."""
