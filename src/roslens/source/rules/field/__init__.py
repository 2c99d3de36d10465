"""What rules are like in the field: tables that were measured come in, shares and rates go out.

Begin with ``precision.py``; ``python -m graph_findings`` writes the tables.
"""
