"""Findings of other tools from files in SARIF.

Begin with ``sarif_input.py``.
"""
