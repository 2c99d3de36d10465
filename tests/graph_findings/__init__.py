"""Whether what the rules of the graph find in public repositories is true: samples, judged by hand, and their page."""
