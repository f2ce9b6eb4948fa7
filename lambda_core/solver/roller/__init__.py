"""Rollers in motion: line contacts, ribs, pockets, equations of motion. Compiled."""
