"""Evaluate one case over many points.

They are quasi-static or dynamic, run on any executor, and can be resumed.
"""
