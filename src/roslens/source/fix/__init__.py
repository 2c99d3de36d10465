"""Findings mended by their edits: chosen, made in memory, parsed again, written, and taken back."""
