"""The live half: what a running ROS system, or a recording of one, does, against what references expect of it.

Graphs, tallies, samples and events of observers come in as frames; verdicts, notes and actions go out. A watch begins
in ``join`` (``session.py``). Rooms, of which each imports only those below it:

============================================ ======================================================================
room                                         what it does
============================================ ======================================================================
``observe``, ``past``, ``drafting``          starts observers; what was kept of a watch; references drafted from one
``react``                                    decides what is done about faults
``adapters``, ``agent``                      observe ROS 1, ROS 2, recordings; sample a host and act on it
``act``, ``mutation``                        carries out actions; puts known faults into recordings
``replay``                                   recordings through the same session, and the alarms that come of it
``publish``                                  tells verdicts to other programs
``join``                                     one session of many observers
``rate``                                     judges what has news or is due
``explain``                                  traces faults to their first cause
``system``                                   what is known of hosts, nodes, topics, connections
``standing``                                 how one constraint about one entity stands
``window``                                   traffic over the last seconds, and the signals that it gives
``reported``, ``inside``                     what nodes report of themselves; what counts in the user's process
============================================ ======================================================================
"""
