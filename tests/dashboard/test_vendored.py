"""Libraries of others that pages load are what their manifest says, and pages load little else."""

from __future__ import annotations

import hashlib
import re
import sys
from pathlib import Path

import pytest

from roslens.dashboard.script_bundle import ENTRIES

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

DASHBOARD = Path(__file__).parents[2] / "src/roslens/dashboard"
VENDORED = DASHBOARD / "live/web/vendored"
MOST_BYTES = 120_000
"""Of JavaScript that a page loads, unpacked and without libraries of others."""


def libraries():
    return tomllib.loads((VENDORED / "manifest.toml").read_text())


def test_every_vendored_file_is_in_the_manifest_and_unchanged():
    named = {path: digest for one in libraries().values() for path, digest in one["sha256"].items()}
    there = {str(path.relative_to(VENDORED)) for path in VENDORED.rglob("*") if path.is_file()} - {"manifest.toml"}
    assert there == set(named)
    for path, digest in named.items():
        assert hashlib.sha256((VENDORED / path).read_bytes()).hexdigest() == digest, path


def test_every_library_has_its_licence_and_says_its_version():
    for name, one in libraries().items():
        assert one["licence"] in (VENDORED / one["licence_file"]).read_text(), name
        assert any(one["version"] in (VENDORED / path).read_text()[:200] for path in one["sha256"]), name


@pytest.mark.parametrize(
    "scripts",
    [["web/main.js"], ["web/main.js", "web/package_graph.js"], ["web/main.js", "web/computation_graph.js"],
     ["live/web/main.js"]],
    ids=lambda scripts: scripts[-1],
)  # fmt: skip
def test_a_page_loads_little_javascript(scripts):
    waiting, found = [DASHBOARD / script for script in scripts], set()
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        for name in re.findall(r'^import .* from "([^"]+)";$', path.read_text(), re.MULTILINE):
            other = (path.parent / name).resolve()
            # The live page's modules are served below those of all pages.
            waiting.append(other if other.exists() else DASHBOARD / "web" / Path(name).relative_to(".."))
    assert sum(path.stat().st_size for path in found) < MOST_BYTES


def test_the_frame_of_a_page_loads_these():
    frame = (DASHBOARD / "templates/frame.html").read_text()
    served = re.findall(r"<script type=\"module\" src=\"{{ asset\('([^']+)'\) }}\">", frame)
    assert sorted(served) == sorted(ENTRIES)
