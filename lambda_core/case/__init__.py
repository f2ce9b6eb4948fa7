"""Declare, read, edit and write case files."""
