"""Store, average, summarise and cite results."""
