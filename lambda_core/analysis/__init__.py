"""Analyses of a machine: rotor, temperatures, bearing currents."""
