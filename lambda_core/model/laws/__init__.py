"""Resolve laws, parameters and functions of time."""
