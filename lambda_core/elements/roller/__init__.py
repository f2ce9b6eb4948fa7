"""Compute rollers by pure functions.

Slices, profiles, load distribution, ratings, lives, rolling resistance and ribs.
"""
