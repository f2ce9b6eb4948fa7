"""Formulas of the literature: Hertz, fits, tolerances, ratings, lives, oils."""
