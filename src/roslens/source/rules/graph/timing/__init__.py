"""Rules on what arrives, how much is kept, and who waits for whom."""
