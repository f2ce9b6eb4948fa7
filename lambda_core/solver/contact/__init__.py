"""Compute the contact of a ball with a raceway.

Compiled.
"""
