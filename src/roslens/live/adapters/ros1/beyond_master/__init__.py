"""What nodes know and the master does not: who runs on after its restart, who is not connected, and own types."""
