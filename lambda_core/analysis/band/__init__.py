"""Compute the model band of results.

Ranges of parameters and exchanged laws change the results.
"""
