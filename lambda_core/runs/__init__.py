"""One run: the loop, stepping, resuming, cross-check, estimate, comparison with methods."""
