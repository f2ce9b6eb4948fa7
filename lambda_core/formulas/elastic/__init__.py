"""Elastic bodies as matrices: shafts as beams, their modes, and reduced models from outside. SI in and out."""
