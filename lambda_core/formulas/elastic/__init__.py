"""Describe elastic bodies by matrices.

Shafts as beams, their modes, imported reduced models. SI in and out.
"""
