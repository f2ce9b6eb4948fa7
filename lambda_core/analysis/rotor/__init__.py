"""Equilibrium, modes and critical speeds of machines, and their text."""
