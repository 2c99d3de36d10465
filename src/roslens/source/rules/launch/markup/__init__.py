"""Rules on what stands in the attributes of launch files in XML."""
