"""The catalogue: bearings, lubricants, materials and cages in SQLite, every value with its source and grade."""
