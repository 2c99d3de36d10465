"""Where the elements of a computation graph stand: one plan for the pages of source, what runs, and both compared."""
