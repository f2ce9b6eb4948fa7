"""A shaft in several bearings: from its case to one equilibrium of the whole, critical speeds, exports."""
