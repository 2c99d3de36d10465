"""What each check of a foreign tool means: tables beside the tools, and the pages made of them.

Begin with ``tool_checks.py``.
"""
