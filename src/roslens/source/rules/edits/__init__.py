"""Edits that mend findings, each in the form of its file."""
