"""The limits that SECURITY names are those of the code."""

from math import ceil

import pytest
from shapes.test_unwatched import MOST_MB as UNWATCHED_MB
from shapes.test_unwatched import MOST_S as UNWATCHED_S

from promises.sentences import GUARANTEES, ROOT, promises
from roslens.children.limits import FILE_BYTES, MEMORY_BYTES
from roslens.cli.workplace.configuration import MOST_BYTES as CONFIGURATION_BYTES
from roslens.dashboard.access.policy import ACTS_EACH_S, MOST_ACTS, MOST_REFUSED, REFUSED_EACH_S
from roslens.dashboard.patient_protocol import MOST_CONNECTIONS, MOST_OF_A_PEER, READING_S, REQUEST_S
from roslens.intake.bounded_file import MOST_SOURCE_BYTES
from roslens.intake.file_budget import LEAST_MEMORY, MORE_S, MOST_MEMORY
from roslens.intake.safe_yaml import MOST_BYTES as MOST_YAML_BYTES
from roslens.intake.safe_yaml import MOST_DEPTH, MOST_DIGITS, MOST_VALUES
from roslens.intake.time_budget import SOURCE_FILE_S
from roslens.judge.documents.yaml_tree import MAX_BYTES, MAX_DEPTH, MAX_NODES
from roslens.live.adapters.bag.decompress import LARGEST, RATIO, UNCHECKED
from roslens.live.agent.link import MOST_KEYS
from roslens.live.agent.request_gate import MOST_REQUESTS, MOST_STRANGE, MOST_WRITTEN, PER_S
from roslens.live.agent.signed_request import FRESH_S, MOST_BYTES
from roslens.live.inside.slots import CAPACITY, MOST_SLOT_BYTES
from roslens.live.observe.listen import MOST_UNPROVEN, MOST_UNPROVEN_OF_A_HOST, PROOF_S
from roslens.plugins.frames import MOST_ANSWER_BYTES, MOST_TASK_BYTES
from roslens.source.extract.launch.refused_yaml import MOST_BYTES as LAUNCH_BYTES
from roslens.source.measure.read_apart import LARGE_BYTES, UNWATCHED_BYTES
from roslens.source.rules.package_findings import MOST_SPENT
from roslens.source.syntax.endless_tree import MOST_LEVELS
from roslens.source.workspace.manifest import MAXIMUM_SIZE


def test_the_limits_of_a_file():
    text = " ".join((ROOT / "SECURITY.md").read_text().split())
    # The kernel counts whole seconds.
    most_s = ceil(SOURCE_FILE_S + MORE_S) + 1
    for limit in (
        f"{MOST_SOURCE_BYTES // 1_000_000} MB, nesting depth {MOST_LEVELS:,}",
        f"{SOURCE_FILE_S:g} s of processor time ({most_s} s where the process has to be ended)",
        f"at least {LEAST_MEMORY // 1_000_000} MB and at most {MOST_MEMORY // 1_000_000_000} GB",
        f"more than {LARGE_BYTES >> 10} KiB is read in a process of its own",
        f"one of more than {UNWATCHED_BYTES >> 10} KiB outside Linux",
        f"{MAXIMUM_SIZE >> 20} MiB per manifest",
    ):
        assert limit in text, limit
    assert MOST_SPENT == 3
    assert "after three that take longer" in text


def guarantee(beginning):
    """Return the limit of a guarantee."""
    (found,) = (one for one in promises() if one.part == GUARANTEES and one.text.startswith(beginning))
    return found.limit


def mb(count):
    return f"{count // 1_000_000} MB"


@pytest.mark.parametrize(
    ("beginning", "limits"),
    [
        ("every other file", [mb(MOST_SOURCE_BYTES), mb(LAUNCH_BYTES)]),
        ("plug-ins: memory", ["4 GB", *map(mb, (FILE_BYTES, MOST_ANSWER_BYTES, MOST_TASK_BYTES))]),
        (
            "YAML in launch files",
            [mb(MOST_YAML_BYTES), f"{MOST_VALUES:,} values", f"depth {MOST_DEPTH}", f"{MOST_DIGITS:,} characters"],
        ),
        ("quality models", [mb(MAX_BYTES), f"{MAX_NODES:,} values", f"depth {MAX_DEPTH}"]),
        ("configuration files", [mb(CONFIGURATION_BYTES)]),
        ("what `fetch`", [f"{UNWATCHED_S} s of processor time", f"{UNWATCHED_MB} MB"]),
        ("a compressed chunk", [mb(LARGEST), f"above {mb(UNCHECKED)}", "a thousand times"]),
        ("unauthenticated", [f"{MOST_UNPROVEN} at a time", f"{MOST_UNPROVEN_OF_A_HOST} per host", f"{PROOF_S:g} s"]),
        (
            "an agent acts only",
            [
                f"{FRESH_S:g} s", f"{MOST_BYTES >> 10} KiB", f"{MOST_REQUESTS} requests a minute",
                f"{MOST_STRANGE} rejected", f"{MOST_WRITTEN} of them logged",
            ],
        ),
        ("counter files", [f"{CAPACITY:,} slots of {MOST_SLOT_BYTES // 1000} kB"]),
        (
            "pages: slow",
            [
                f"{REQUEST_S:g} s for a request", f"{READING_S:g} s in which", f"{MOST_CONNECTIONS} connections",
                f"{MOST_OF_A_PEER} per address",
            ],
        ),
        (
            "viewing pages",
            [
                f"{MOST_REFUSED} wrong tokens of a source, then one every {REFUSED_EACH_S:g} s",
                f"{MOST_ACTS} actions, then one every {ACTS_EACH_S:g} s",
            ],
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)  # fmt: skip
def test_the_limits_of_a_guarantee(beginning, limits):
    text = guarantee(beginning)
    assert [limit for limit in limits if limit not in text] == []


def test_limits_that_are_written_in_words():
    (found,) = (one.text for one in promises() if one.text.startswith("a host is bound to the first key"))
    assert f"up to {MOST_KEYS} keys" in found
    assert (MEMORY_BYTES, RATIO) == (4_000_000_000, 1000)
    assert PER_S == 60
