"""Source as pages show it."""
