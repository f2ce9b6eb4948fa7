"""Evaluate one case over many points.

Quasi-static or dynamic, on any executor, resumable.
"""
