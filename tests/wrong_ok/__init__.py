"""A gate of wrong oks and of harm: what is wrong is never called ok, and no reaction makes it worse."""
