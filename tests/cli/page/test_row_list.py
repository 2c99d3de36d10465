"""Rows that are made anew only where the tree changed are the rows made from scratch."""

from __future__ import annotations

from random import Random

import pytest
from live.test_live_tree import SECONDS, Watched, history

from roslens.cli.page.row_list import MOST_GONE_ROWS, RowList
from roslens.dashboard.live.snapshot import UNJUDGED
from roslens.live.system.tree import SystemView


@pytest.mark.parametrize("seed", range(30))
def test_rows_and_what_is_told_of_all_of_them_are_as_from_scratch(seed: int) -> None:
    draw = Random(seed)
    watched, kept = Watched(), RowList()
    events, now, before = history(draw), 0.0, None
    while now < SECONDS + 3:
        now += draw.choice([0.05, 0.25, 1.1])
        while events and events[0][0] <= now:
            time, _, what, value = events.pop(0)
            watched.take(time, what, value)
        watched.monitor.tick(now)
        view = watched.monitor.tree(now)
        rows = kept.of(view)
        assert rows == RowList().of(view), f"seed {seed} at {now:.2f} s"
        assert kept.columns == {column for row in rows for column in row.shown}
        unjudged = {row.entity for row in rows if row.state == UNJUDGED}
        assert kept.unjudged == len({one for one in unjudged if not one.endswith(":")})
        keys = [row.key for row in rows]
        if before is not None:
            assert (before[1] is kept.order) == (before[0] == keys)
        before = keys, kept.order


def test_what_went_is_given_up_and_rows_of_what_stays_are_kept() -> None:
    """A tool comes and goes with every look: it leaves no more than a bounded number of rows behind."""
    stays = SystemView("node:/stays", "/stays", "node", children=(SystemView("topic:/t", "/t", "topic"),))
    kept = RowList()
    first = {row.key: row for row in kept.of(SystemView("system", "", "system", children=(stays,)))}
    most = 0
    for number in range(4 * MOST_GONE_ROWS):
        tool = SystemView(f"node:/tool{number}", f"/tool{number}", "node")
        rows = kept.of(SystemView("system", "", "system", children=(stays, tool)))
        assert [row for row in rows if first.get(row.key) is row] == list(first.values())
        most = max(most, kept.remembered)
    assert most <= MOST_GONE_ROWS + len(first) + 1
