"""What may be done about a fault: conditions, reactions, and what is asked of those who act."""
