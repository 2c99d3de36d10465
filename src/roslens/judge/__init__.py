"""Values against what is asked of them: quality models for source, references for running systems.

Documents and values come in; constraints, ratings and findings go out. Nothing here does I/O but to read a document.
Rooms, of which each imports only those below it:

============================================ ======================================================================
room                                         what it does
============================================ ======================================================================
``arni``, ``pages``                          references from files of ARNI; reference pages and schemas
``reading``                                  YAML documents as references
``reference``, ``quality``                   what a reference expects; what a quality model limits, and its findings
``documents``, ``patterns``, ``ranges``      YAML with places; patterns on names; ranges and amounts with units
============================================ ======================================================================
"""
