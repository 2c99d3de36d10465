"""Recall of coding rules by mutation: what breaks a rule is planted into real files, and the command line looks."""
