"""Compute contacts of the cage and between balls.

Compiled.
"""
