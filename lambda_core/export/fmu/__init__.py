"""Export bearings and machines as FMUs without Python."""
