"""Choose and draw views; write reports."""
