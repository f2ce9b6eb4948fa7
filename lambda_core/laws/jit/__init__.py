"""Compile plain Python functions and keep the machine code.

All use of Numba's or Python's internals is here.
"""
