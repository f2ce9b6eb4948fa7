"""Compute the contact of a ball with a raceway.

All of it is compiled.
"""
