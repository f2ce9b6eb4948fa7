"""Check and describe a resolved machine."""
