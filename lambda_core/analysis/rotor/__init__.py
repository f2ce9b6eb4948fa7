"""Compute equilibrium, modes and critical speeds of machines."""
