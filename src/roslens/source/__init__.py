"""The source half: from files on disk to measured and judged packages."""
