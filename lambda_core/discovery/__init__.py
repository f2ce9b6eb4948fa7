"""Find, check and create plugins."""
