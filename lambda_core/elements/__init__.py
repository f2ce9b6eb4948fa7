"""Kinds of rolling elements: what is particular to each, in one folder."""
