"""Which packages there are, which files they have, and what each file is."""
