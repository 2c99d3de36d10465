"""What is done about faults: conditions, gates, actions and what is told of them."""
