"""What the commands that serve pages share."""
