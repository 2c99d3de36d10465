"""All pages of configurations, and all of them in one file."""

from __future__ import annotations

import re
from pathlib import Path
from types import ModuleType

import pytest

from roslens.dashboard.computation.pages import computation_file, computation_page, computation_pages
from roslens.model.configuration import Configuration
from roslens.model.errors import UsageError


def test_there_is_a_page_for_each_element_that_says_something(made_up: ModuleType) -> None:
    views = list(computation_pages({"rover": made_up.robot()}))
    pages = [view.ref.page for view in views]
    assert pages.count("computation") == 1
    assert pages.count("node") == len(made_up.robot().nodes)
    assert "/scan" in {view.title for view in views}
    assert "/rosout" not in {view.title for view in views}


def test_one_file_loads_nothing_and_every_link_leads_somewhere(made_up: ModuleType) -> None:
    text = computation_page({"rover": made_up.robot(), "again": made_up.robot()}, {"rover": made_up.robot_findings()})
    assert text == computation_page(
        {"rover": made_up.robot(), "again": made_up.robot()}, {"rover": made_up.robot_findings()}
    )
    assert not re.findall(r'(?:src|href)="(?!#|data:)[^"]*"', text)
    ids = re.findall(r' id="([^"]+)"', text)
    assert len(ids) == len(set(ids))
    assert "/scan" in text


def test_names_from_source_stay_text() -> None:
    text = computation_page({"<b>": Configuration("<script>alert(1)</script>", "ros2")})
    assert "<script>alert" not in text


def test_nothing_to_show_is_said() -> None:
    assert "starts no node" in computation_page({"empty": Configuration("empty.launch.py", "ros2")})
    assert "</html>" in computation_page({})


def test_the_file_is_written_or_it_is_said_why_not(made_up: ModuleType, tmp_path: Path) -> None:
    computation_file({"rover": made_up.robot()}, tmp_path / "rover.html")
    assert (tmp_path / "rover.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    with pytest.raises(UsageError, match="--html"):
        computation_file({}, tmp_path)
