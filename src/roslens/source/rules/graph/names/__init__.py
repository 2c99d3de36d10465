"""Rules of the computation graph on names and namespaces."""
