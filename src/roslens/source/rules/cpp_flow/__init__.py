"""What flows where within one file of C++, as rules ask it.

Begin with ``callback_chain.py`` (from which callback a place is reached, through which functions), ``keeper.py`` (which
local variable keeps a value, and how long) and ``variable_type.py`` (what a name is declared as).
"""
