"""Resolve settings of solver, temperatures, circuit and observers."""
