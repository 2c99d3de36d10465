"""Kinds of action, one file each: how it is prepared and how it is done."""
