"""Make the arrays of compiled code without the compiler."""
