"""Resolve designation, clearance, rows and shoulders of a bearing."""
