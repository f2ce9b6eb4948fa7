"""Fit parameters to measurements and state their uncertainty."""
