"""Provide cases to start from."""
