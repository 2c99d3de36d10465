"""What shows that a store holds what roslens of this user wrote into it, and nothing else."""
