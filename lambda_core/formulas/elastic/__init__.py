"""Describe elastic bodies by matrices.

The bodies are shafts as beams, their modes, and imported reduced models. Units are SI.
"""
