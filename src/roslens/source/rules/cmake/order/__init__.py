"""Rules on commands of CMake that come too late."""
