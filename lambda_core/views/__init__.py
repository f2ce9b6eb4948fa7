"""What views and comparison methods give: charts, scenes, tables, rows of numbers."""
