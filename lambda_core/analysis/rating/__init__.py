"""Rate equilibria by the installed methods."""
