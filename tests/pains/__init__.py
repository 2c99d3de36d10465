"""What `roslens why` says of frequent reasons for missing data, each made to happen; docs/why.md shows it."""
