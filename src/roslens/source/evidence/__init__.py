"""What shows, in a package and its repository, which requirements of REP-2004 are met."""
