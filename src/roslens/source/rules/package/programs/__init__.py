"""Rules on how the programs of a package are installed, found and started."""
