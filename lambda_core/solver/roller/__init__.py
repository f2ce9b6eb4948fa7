"""Compute rollers in motion.

Line contacts, ribs, pockets, equations of motion. Compiled.
"""
