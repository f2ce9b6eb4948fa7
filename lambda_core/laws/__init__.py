"""Laws: what one is, the contract of its role, and the checks that it keeps it."""
