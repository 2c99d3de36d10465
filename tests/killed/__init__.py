"""Commands that end at any moment: on request, killed, without memory, on a full disk."""
