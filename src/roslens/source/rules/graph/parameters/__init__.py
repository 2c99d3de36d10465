"""Rules on parameters of nodes, and the files that set them."""
