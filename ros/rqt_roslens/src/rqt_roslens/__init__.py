"""View of a running robot by roslens, in rqt."""
