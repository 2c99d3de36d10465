"""From a run in the store to text: one format per file."""
