"""Data of a forge on a repository: issues and requests, requested only if the user enables it."""
