"""Temperatures from losses: a thermal network around the bearing, steady and over time."""
