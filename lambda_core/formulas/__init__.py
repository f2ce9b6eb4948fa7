"""Provide formulas of the literature."""
