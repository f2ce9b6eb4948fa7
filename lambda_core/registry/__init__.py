"""Roles, models, plugins and the catalogue's contract."""
