"""Process metrics, one a file: pure functions of commits."""
