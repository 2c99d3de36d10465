"""How foreign tools are run: which files, by which program, within which time, and what of it is kept.

Begin with ``tool_stage.py``.
"""
