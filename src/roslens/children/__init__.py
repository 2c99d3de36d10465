"""Processes that roslens starts: nothing of the folder that is looked at runs in them, and none outlives its parent."""
