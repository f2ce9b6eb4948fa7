"""Compute rollers in motion.

It covers line contacts, ribs, pockets and equations of motion. It is compiled.
"""
