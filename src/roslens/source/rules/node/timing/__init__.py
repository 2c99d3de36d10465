"""Rules on time: clocks, rates, stamps."""
