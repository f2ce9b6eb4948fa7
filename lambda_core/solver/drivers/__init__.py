"""Drive the compiled code from Python.

No compiled code imports it.
"""
