"""Provide the command line, one module per command."""
