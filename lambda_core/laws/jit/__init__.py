"""From plain Python functions to machine code on disk: all that touches Numba's or Python's internals."""
