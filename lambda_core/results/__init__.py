"""Result files, averages, convergence, summaries, citations."""
