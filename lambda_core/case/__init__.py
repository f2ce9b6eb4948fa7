"""The case file: its options, reading, writing, drafts, every mistake as a sentence."""
