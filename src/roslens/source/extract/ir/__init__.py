"""Programs: what C++ and Python are lowered to, as text and as it is kept, and what can be read off them alone.

Lowerings make them, the interpreter follows them. Begin with ``program.py``; ``program_text.py`` writes and reads
one.
"""
