"""Rules on publishers, subscriptions, timers, services and clients."""
