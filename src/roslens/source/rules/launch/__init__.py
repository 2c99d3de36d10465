"""Rules on launch files, in XML, YAML and Python, and on the parameter files beside them."""
