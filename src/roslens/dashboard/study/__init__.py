"""The page of a study: its tables, and plots drawn as SVG."""
