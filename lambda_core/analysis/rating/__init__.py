"""Rate equilibria: lives, safety and catalogue friction, by the installed methods."""
