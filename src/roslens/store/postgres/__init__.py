"""The store in a database of PostgreSQL that several machines share: the same statements, translated."""
