"""What is seen and judged, told to others: diagnostics, Prometheus, lines of JSON."""
