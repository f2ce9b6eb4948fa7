"""Quasi-static equilibrium by pseudo-transient continuation. Compiled."""
