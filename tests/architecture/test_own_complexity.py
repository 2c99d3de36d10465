"""roslens measures itself: fewer and fewer functions of its own are above the limit that it suggests to others."""

from pathlib import Path

from roslens.source.metrics.complexity.cognitive_complexity import of_function
from roslens.source.settings import CountingSettings
from roslens.source.syntax.python import parse_python

SOURCE = Path(__file__).parents[2] / "src" / "roslens"
LIMIT = 15
ABOVE, WORST = 85, 43
"""So many functions are above the limit, and the worst is this: whoever divides one lowers the numbers."""
SLACK = 8


def test_cognitive_complexity_only_becomes_less():
    counting = CountingSettings()
    found = {
        f"{path.relative_to(SOURCE)}: {one.qualified_name}": value
        for path in sorted(SOURCE.rglob("*.py"))
        for one in parse_python(path.read_bytes()).functions
        if (value := of_function(one, counting)) > LIMIT
    }
    worst = {name: value for name, value in found.items() if value > WORST}
    assert not worst, f"divide what is above {WORST}: {worst}"
    assert len(found) <= ABOVE, f"{len(found)} functions are above {LIMIT}, {ABOVE} were: divide what is new of {found}"
    assert len(found) > ABOVE - SLACK, f"{len(found)} functions are above {LIMIT} now: lower the number here"
