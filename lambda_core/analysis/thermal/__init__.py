"""Compute temperatures from losses by a thermal network."""
