"""The model builder: a terminal interface from designation to result."""
