"""Makes tables of what distributions deprecated and removed, from the branches of a repository."""
