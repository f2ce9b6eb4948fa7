"""Time: integration, runs, results, summaries."""
