"""Rollers: slices, profiles, load distribution, ratings, lives, rolling resistance and ribs, as pure functions."""
