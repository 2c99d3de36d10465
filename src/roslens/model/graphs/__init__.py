"""What a run looked at of its computation graphs, and how much of each is known."""
