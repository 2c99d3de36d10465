"""Published coding standards: what they ask, and which rules answer it."""
