"""Where graph and traffic come from, one folder per source. None imports another."""
