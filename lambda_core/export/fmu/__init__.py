"""Bearings for other programs: co-simulation units (FMI) with the compiled solver inside, and no Python."""
