"""Bodies of a machine: rings, cage, shaft, housing, materials, places."""
