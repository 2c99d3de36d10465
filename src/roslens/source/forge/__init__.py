"""What a forge knows of a repository: issues and requests, asked for only where the user says so."""
