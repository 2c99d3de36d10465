"""What other programs get of a reference: rules for Prometheus, routes for Alertmanager, dashboards, layouts.

In comes a merged reference; out come files of those programs. Begin with ``prometheus_rules.py``.
"""
