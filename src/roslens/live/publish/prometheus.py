"""The text that Prometheus reads (exposition format 0.0.4): a gauge per signal, and how each constraint stands.

``roslens_rate_hertz{topic="/scan",publisher="/lidar",subscriber="/slam"} 25.1``
``roslens_state{kind="topic",name="/scan",expectation="rover.scan.rate",severity="warning",state="ok"} 1``

A signal that is not known has no line; a verdict has one line with its state as a label, so that an alert asks for
``roslens_state{state=~"low|high|absent"}``. Of a journal there is how many entries it has, whether its end is as it was
signed, and the hash of its last entry as a label: Prometheus keeps what it was, so a tail that is cut off shows.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from roslens.live.system.connection_name import connection_ends
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import Verdict
from roslens.store.journals.journal_head import JournalHead

CONTENT_TYPE = "text/plain; version=0.0.4; charset=utf-8"

_UNITS = {
    "Hz": "_hertz",
    "s": "_seconds",
    "B": "_bytes",
    "B/s": "_bytes_per_second",
    "%": "_percent",
    "degC": "_celsius",
    "": "",
}
_ESCAPES = str.maketrans({"\\": r"\\", '"': r"\"", "\n": r"\n"})


def prometheus_text(
    readings: Iterable[tuple[EntityId, Mapping[str, float]]],
    verdicts: Iterable[Verdict],
    counters: Mapping[str, float] | None = None,
    journals: Sequence[JournalHead] = (),
) -> str:
    """Return the page.

    Args:
        readings: latest values of entities, by key of the signal.
        verdicts: that stand.
        counters: what roslens tells of itself, by name without ``roslens_``.
        journals: where they end.
    """
    lines: list[str] = []
    rows: dict[str, list[str]] = {}
    for entity, values in readings:
        labels = _labels(entity)
        for key, value in values.items():
            if key in BY_KEY:
                rows.setdefault(key, []).append(f"{{{labels}}} {_number(value)}")
    for key, signal in BY_KEY.items():
        if key in rows:
            name = metric_name(key)
            lines += [f"# HELP {name} {_help(signal.text)}", f"# TYPE {name} gauge"]
            lines += [name + row for row in rows[key]]
    states = [_state(verdict) for verdict in verdicts]
    if states:
        lines += [
            "# HELP roslens_state State of a constraint of the reference.",
            "# TYPE roslens_state gauge",
            *states,
        ]
    lines += _of_journals(journals)
    for name, value in (counters or {}).items():
        lines += [f"# TYPE roslens_{name} gauge", f"roslens_{name} {_number(value)}"]
    return "\n".join(lines) + "\n"


def _of_journals(journals: Sequence[JournalHead]) -> list[str]:
    if not journals:
        return []
    paths = [_escaped(one.path) for one in journals]
    hashes = [(path, one.hash) for path, one in zip(paths, journals, strict=True) if one.hash]
    return [
        "# HELP roslens_journal_entries Entries of a journal; fewer than before where its end was cut off.",
        "# TYPE roslens_journal_entries gauge",
        *(
            f'roslens_journal_entries{{journal="{path}"}} {one.entries}'
            for path, one in zip(paths, journals, strict=True)
        ),
        "# HELP roslens_journal_whole Whether a journal ends as it was signed.",
        "# TYPE roslens_journal_whole gauge",
        *(
            f'roslens_journal_whole{{journal="{path}"}} {not one.wrong:d}'
            for path, one in zip(paths, journals, strict=True)
        ),
        "# HELP roslens_journal_head Hash of the last entry of a journal, for `roslens journal --verify --head`.",
        "# TYPE roslens_journal_head gauge",
        *(f'roslens_journal_head{{journal="{path}",hash="{found}"}} 1' for path, found in hashes),
    ]


def metric_name(key: str) -> str:
    """Return the name of the metric of a signal: ``roslens_rate_hertz``."""
    return f"roslens_{key}{_UNITS[BY_KEY[key].unit]}"


def _labels(entity: EntityId) -> str:
    if entity.kind is EntityKind.CONNECTION:
        topic, publisher, subscriber = connection_ends(entity)
        pairs = {"topic": topic, "publisher": publisher, "subscriber": subscriber}
    elif entity.kind is EntityKind.PROCESS:
        host, _, pid = entity.name.rpartition("/")
        pairs = {"host": host, "pid": pid}
    else:
        pairs = {entity.kind.value: entity.name}
    return ",".join(f'{name}="{_escaped(value)}"' for name, value in pairs.items())


def _state(verdict: Verdict) -> str:
    pairs = {
        "kind": verdict.entity.kind.value,
        "name": verdict.entity.name,
        "expectation": verdict.expectation,
        "quantity": verdict.quantity,
        "severity": verdict.severity.value,
        "state": verdict.state.value,
        "cause": verdict.cause,
    }
    labels = ",".join(f'{name}="{_escaped(value)}"' for name, value in pairs.items() if value)
    return f"roslens_state{{{labels}}} 1"


def _escaped(text: str) -> str:
    return text.translate(_ESCAPES)


def _help(text: str) -> str:
    return text.replace("\\", r"\\").replace("\n", r"\n")


def _number(value: float) -> str:
    return repr(float(value)).replace("inf", "Inf").replace("nan", "NaN")
