"""The engineer's language: units, the case model and its files."""
