"""Pages over a run: served, as a folder, or as one file, all from the same page functions and templates."""
