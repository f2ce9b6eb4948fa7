"""Provide the model builder in the terminal."""
