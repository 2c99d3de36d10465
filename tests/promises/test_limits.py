"""The limits that SECURITY names are those of the code."""

from math import ceil

from promises.sentences import ROOT
from roslens.intake.bounded_file import MOST_SOURCE_BYTES
from roslens.intake.file_budget import LEAST_MEMORY, MORE_S, MOST_MEMORY
from roslens.intake.time_budget import SOURCE_FILE_S
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
        f"one of more than {UNWATCHED_BYTES >> 10} KiB in `serve` and `lsp` and on a cluster",
        f"{MAXIMUM_SIZE >> 20} MiB per manifest",
    ):
        assert limit in text, limit
    assert MOST_SPENT == 3
    assert "after three that take longer" in text
