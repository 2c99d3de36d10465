"""What git tells of how source came to be: process metrics, and past revisions."""
