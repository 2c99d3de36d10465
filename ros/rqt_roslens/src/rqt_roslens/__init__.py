"""What roslens says of a robot that runs, in rqt."""
