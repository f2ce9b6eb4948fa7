"""Arrays that compiled code works on, and how they are made: known without the compiler."""
