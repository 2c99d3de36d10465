"""A system as it was: what is kept of a session, and the same tree from what was kept."""
