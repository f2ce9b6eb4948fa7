"""Geometry of a bearing: designation, clearance, rows, shoulders."""
