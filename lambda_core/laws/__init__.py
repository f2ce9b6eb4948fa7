"""Define laws, the contracts of roles and their checks."""
