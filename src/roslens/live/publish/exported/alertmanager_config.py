"""A configuration of Alertmanager for the alerts of a reference: it notifies of first causes, not of their effects."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import yaml

from roslens.live.publish.exported.prometheus_rules import NOT_HEARD

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference

_HEAD = """\
# Routes for the alerts of the reference {name}, made by `roslens reference export --alertmanager`.
# Configure the receivers: webhook_configs, email_configs and others. What follows from a first cause
# goes to a receiver that notifies no one.
"""


def alertmanager_config(reference: Reference) -> str:
    """Return the configuration as YAML; its receivers have names, and whom they tell is left to who installs it."""
    mine = f'reference="{reference.name}"'
    document: dict[str, Any] = {
        "route": {
            "receiver": "roslens",
            "group_by": ["reference", "group"],
            "group_wait": "10s",
            "group_interval": "1m",
            "repeat_interval": "4h",
            "routes": [
                {"matchers": [mine, 'cause!=""'], "receiver": "roslens-consequences"},
                {"matchers": [mine, 'severity="error"'], "receiver": "roslens-urgent", "group_wait": "0s"},
            ],
        },
        "inhibit_rules": [
            {
                "source_matchers": [f'alertname="{NOT_HEARD}"', mine],
                "target_matchers": [f'alertname!="{NOT_HEARD}"', mine],
            },
            {
                "source_matchers": [mine, 'severity="error"'],
                "target_matchers": [mine, 'severity=~"warning|note"'],
                "equal": ["kind", "name"],
            },
        ],
        "receivers": [{"name": name} for name in ("roslens", "roslens-urgent", "roslens-consequences")],
    }
    return _HEAD.format(name=reference.name) + str(yaml.safe_dump(document, sort_keys=False, width=110))
