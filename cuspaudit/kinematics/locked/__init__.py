"""An arm with one joint to spare, at every value at which that joint may be locked."""
