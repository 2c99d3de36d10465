from pathlib import Path

import pytest

from roslens.source.known_manifests import KnownManifests
from roslens.source.workspace.manifest import read_manifest
from roslens.store.cache import Cache

MANIFEST = b"""<package format="3"><name>arm</name><version>1.0</version>
<depend condition="$ROS_VERSION == 2">rclcpp</depend></package>"""


def test_what_was_read_before_is_the_same_and_is_not_read_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    expected = read_manifest(MANIFEST, "arm/package.xml", {"ROS_VERSION": "2"})
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        first = KnownManifests(cache)
        assert first.read(MANIFEST, "arm/package.xml", {"ROS_VERSION": "2"}) == expected
        first.keep()
        monkeypatch.setattr("roslens.source.workspace.manifest.read_manifest", None)
        assert KnownManifests(cache).read(MANIFEST, "arm/package.xml", {"ROS_VERSION": "2"}) == expected


@pytest.mark.parametrize(
    ("content", "path", "environment"),
    [
        (MANIFEST + b" ", "arm/package.xml", {"ROS_VERSION": "2"}),
        (MANIFEST, "leg/package.xml", {"ROS_VERSION": "2"}),
        (MANIFEST, "arm/package.xml", {"ROS_VERSION": "1"}),
    ],
)
def test_other_content_place_or_environment_is_read(tmp_path: Path, content: bytes, path: str, environment):
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        first = KnownManifests(cache)
        first.read(MANIFEST, "arm/package.xml", {"ROS_VERSION": "2"})
        first.keep()
        assert KnownManifests(cache).read(content, path, environment) == read_manifest(content, path, environment)


def test_without_a_cache_it_is_read(tmp_path: Path):
    with Cache.open(None) as cache:
        manifests = KnownManifests(cache)
        assert manifests.read(MANIFEST, "p", {}) == read_manifest(MANIFEST, "p", {})
        manifests.keep()
