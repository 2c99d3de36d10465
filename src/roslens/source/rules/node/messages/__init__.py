"""Rules on messages: how they are made, filled, handed on."""
