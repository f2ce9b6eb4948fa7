"""Resolve the bodies of a machine."""
