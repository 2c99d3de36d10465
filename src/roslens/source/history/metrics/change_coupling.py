"""What changes together."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import combinations

from roslens.model.entity import EntityKind
from roslens.model.process import Coupling
from roslens.model.quantity import Quantity

LARGEST_COMMIT = 30
"""A commit that changes more is no evidence of coupling: a reformatting, a licence."""
FEWEST_SHARED = 5
RELEASE_FILES = re.compile(r"(?:.*/)?(?:package\.xml|CHANGELOG\.\w+)")
"""Files that every release changes in every package, which is no evidence either."""
LEAST_DEGREE = 0.3

QUANTITY = Quantity(
    key="change_coupling",
    title="Change coupling",
    unit="partners",
    kinds=(EntityKind.PACKAGE, EntityKind.FILE),
    text="How many others of its kind in the repository change together with it.",
    formula=f"number of others with at least {FEWEST_SHARED} commits that change both, and with (commits that change "
    f"both) / (mean of the commits that change each) at least {LEAST_DEGREE:g}; merges and commits that change more "
    f"than {LARGEST_COMMIT} files do not count, and neither do `package.xml` and `CHANGELOG.*`, which releases change",
    source="Gall, Hajek and Jazayeri, Detection of Logical Coupling Based on Product Release History, ICSM 1998; the "
    "limits are the defaults of code-maat (github.com/adamtornhill/code-maat)",
    limits="Related changes in separate commits are not detected.",
)

COMMANDS = {
    "file": "comm -12 <(git log --follow --topo-order --no-merges --format=%H HEAD -- PATH | sort) "
    "<(git log --follow --topo-order --no-merges --format=%H HEAD -- OTHER | sort) | wc -l    (less what is too large)",
    "path": "comm -12 <(git rev-list --no-merges --full-history HEAD -- PATH | sort) "
    "<(git rev-list --no-merges --full-history HEAD -- OTHER | sort) | wc -l    (less what is too large)",
}


def couplings(commits: Iterable[tuple[int, frozenset[str]]]) -> tuple[Coupling, ...]:
    """Return the pairs that change together, the most often first.

    Args:
        commits: that are no merge, each with how many files it changes and the names that it touches.
    """
    single: Counter[str] = Counter()
    shared: Counter[tuple[str, str]] = Counter()
    for number, names in commits:
        if number <= LARGEST_COMMIT:
            for name in names:
                single[name] += 1
            if len(names) > 1:
                shared.update(combinations(sorted(names), 2))
    return tuple(sorted(_coupled(single, shared), key=lambda one: (-one.shared, -one.degree, one.first, one.second)))


def _coupled(single: Counter[str], shared: Counter[tuple[str, str]]) -> Iterator[Coupling]:
    for (first, second), number in shared.items():
        degree = 2 * number / (single[first] + single[second])
        if number >= FEWEST_SHARED and degree >= LEAST_DEGREE:
            yield Coupling(first, second, number, round(degree, 4))


def partners(found: Iterable[Coupling]) -> Counter[str]:
    """Return how many partners each name has."""
    return Counter(name for one in found for name in (one.first, one.second))
