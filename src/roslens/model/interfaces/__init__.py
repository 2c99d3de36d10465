"""Messages, services and actions as both halves and reports know them: how they change, and whom that affects."""
