"""Rules that come with roslens: a folder for each family, one rule a file.

In come parsed files, packages and configurations; out come findings. Begin with ``rule.py``, which says what a rule
declares; ``match_file.py`` and ``package_findings.py`` apply them, and nothing but its folder names a rule.

==================================== ==============================================================================
room                                 what it has
==================================== ==============================================================================
``cpp``, ``python``                  rules that any program should follow
``node``                             rules on code of nodes: callbacks, endpoints, lifetime, time
``package``, ``cmake``, ``launch``   rules on manifests, builds and launch files
``graph``                            rules on computation graphs: names, types, ``parameters``, and in ``timing``
                                     quality of service, queues and deadlocks
``cpp_flow``                         what flows where within one file of C++: callbacks, helpers, variables, handlers
``by_package``, ``views``            what makes findings of a package notes; what rules on packages look at
``flow``                             which functions callbacks reach by calls, and what keeps back what they wait for
``edits``                            edits that mend findings
``published``, ``field``             coding standards, and how rules fare in the field
==================================== ==============================================================================
"""
