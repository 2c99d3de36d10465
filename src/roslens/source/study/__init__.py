"""What many packages together say: distributions, correlations, roles."""
