"""Analyse machines: rotor, temperatures, bearing currents."""
