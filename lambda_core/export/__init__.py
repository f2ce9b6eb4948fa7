"""Export machines to other programs and documents."""
