"""What was counted and sampled."""
