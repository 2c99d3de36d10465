"""What a reference drafted from a running robot reports of the faults of that robot."""
