"""What other programs are told of a reference: rules for Prometheus, routes for Alertmanager, dashboards, layouts."""
