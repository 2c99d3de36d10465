"""Rules on what callbacks do: an executor that waits for one runs no other."""
