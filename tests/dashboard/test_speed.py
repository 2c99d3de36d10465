"""How long a reader waits for a page of a large workspace."""

from __future__ import annotations

import time
from typing import Any

import pytest
from pace import turned_s

from roslens.dashboard.address import ServedLinks
from roslens.dashboard.export import pages_of
from roslens.dashboard.routes import OF_THE_PAST, PAGES, SERVED_ALONE
from roslens.dashboard.site import Site

LONGEST = 1.0


@pytest.mark.heavy
@pytest.mark.timed
@pytest.mark.parametrize("page", [page for page in PAGES if page not in OF_THE_PAST | SERVED_ALONE])
def test_a_page_of_a_large_workspace_answers_within_a_second(large_site: Site, large_client: Any, page: str) -> None:
    ref = next(ref for ref in pages_of(large_site) if ref.page == page)
    begun = time.process_time()
    answer = large_client.get(ServedLinks().to(ref))
    took = turned_s(begun)
    assert answer.status_code == 200
    assert took < LONGEST, f"{took:.2f} s"
