"""An arm with a joint to spare: the verdict at every value at which it is locked."""
