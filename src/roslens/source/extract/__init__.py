"""What source says of the computation graph: lowered, evaluated, assembled; never executed."""
