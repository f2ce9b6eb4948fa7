"""The command line of lambda-bearing; one module per command."""
