"""Fit parameters to measurements, and tell how well a result is known."""
