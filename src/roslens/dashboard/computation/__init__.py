"""The computation graph from source as pages: nodes, topics, services, actions, and what shows that they are there."""
