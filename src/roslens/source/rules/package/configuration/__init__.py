"""Rules on parameter files that name plug-ins."""
