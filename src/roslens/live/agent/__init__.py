"""What runs on each host: samples the machine and its processes and sends packed records, never payloads."""
