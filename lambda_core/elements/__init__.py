"""Hold each kind of rolling element in its folder."""
