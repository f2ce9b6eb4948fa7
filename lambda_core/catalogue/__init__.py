"""The catalogue's contract and the reading of designations."""
