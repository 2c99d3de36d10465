"""Which of several observers of one connection is believed."""

from __future__ import annotations

from roslens.model.traffic.tally import Observer

RANK = {
    Observer.INSIDE: 0,
    Observer.SCRIPTED: 1,
    Observer.TAP: 2,
    Observer.PROTOCOL: 3,
    Observer.RECORDING: 4,
    Observer.AGENT: 5,
}
"""How good an observer is; the least is the best."""
