"""The command line: the only place that joins the layers.

Arguments come in; text, exit codes and served pages go out. Begin with ``main.py``; each command goes on in its file of
``commands``. Rooms, of which each imports only those below it:

========================================= =========================================================================
room                                      what it does
========================================= =========================================================================
``commands``                              one verb per file
``conformance``, ``editor``, ``top``      sides of a comparison; the language server; the screen of ``roslens top``
``why``                                   what ``roslens why`` looks at
``served``, ``references``                what is served besides a run; verbs of ``roslens reference``
``react``                                 acting by a reference: live or simulated
``watch``                                 watching what runs: sources, sinks, lines
``page``                                  what the live page and the terminal show of a watch
``past``                                  past revisions as runs
``check``                                 what ``roslens check`` analyses, compares, fixes and writes
``interfaces``                            messages, services and actions at two times, and who uses them
``graph``                                 configurations of a workspace, shown and checked
``git``                                   revisions of a repository, read without a checkout
``workplace``                             configuration, store, trust: what a workspace and a user decide
``terminal``                              streams, progress, exit codes
========================================= =========================================================================
"""
