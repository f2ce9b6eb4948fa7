"""Compute contacts of the cage and between balls.

All of it is compiled.
"""
