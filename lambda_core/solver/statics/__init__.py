"""Solve the quasi-static equilibrium by pseudo-transient continuation."""
