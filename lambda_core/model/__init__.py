"""Resolve cases: every value of a machine with its origin."""
