"""From a resolved case to forces: geometry, contact pipeline, equilibrium, compiled kernels."""
