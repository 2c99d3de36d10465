"""How one constraint about one entity stands: ready to be judged many times a second, with its timing and evidence.

In come expectations of references and values at an instant; out come verdicts. Begin with ``standing.py``;
``verdict_state.py`` says when a state changes.
"""
