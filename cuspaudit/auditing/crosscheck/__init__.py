"""The second opinion: pinocchio and a second program for det J."""
