"""Define the catalogue's contract; read designations."""
