"""The model band of results: ranges of parameters, laws exchanged, and what both do to results."""
