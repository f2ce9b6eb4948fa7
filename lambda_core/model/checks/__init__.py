"""Checks and descriptions of a resolved machine."""
