"""Rules on packages: manifests, builds, launch files, Python packaging."""
