"""Define errors, units, roles, channels and other shared terms."""
