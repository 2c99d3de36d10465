"""How hypothesis works here: a busy machine is no fault, and `make quick` takes fewer examples."""

import os

from hypothesis import HealthCheck, settings

settings.register_profile("roslens", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("quick", settings.get_profile("roslens"), max_examples=25)
settings.load_profile("quick" if os.environ.get("ROSLENS_QUICK") else "roslens")
