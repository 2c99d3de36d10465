"""Statistics over many packages: distributions, correlations, roles."""
