"""How hypothesis works here: a busy machine is no fault, and `make quick` takes fewer examples.

`make test` takes the same examples each time, so that what it says is about the change and not about luck; every other
run searches anew.
"""

import os

from hypothesis import HealthCheck, settings

settings.register_profile("roslens", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("quick", settings.get_profile("roslens"), max_examples=25)
settings.register_profile("same", settings.get_profile("roslens"), derandomize=True, database=None)
if os.environ.get("ROSLENS_QUICK"):
    settings.load_profile("quick")
else:
    settings.load_profile("same" if os.environ.get("ROSLENS_SAME_EXAMPLES") else "roslens")
