"""Define the results of views and comparison methods.

These are charts, scenes, tables and rows of numbers.
"""
