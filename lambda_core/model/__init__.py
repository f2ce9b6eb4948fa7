"""The resolved model of a machine: every value with its origin."""
