"""A target among packages is refused for sure; a name that is almost that of a package is probably misspelt."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.cmake.package_name import found

MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_cmake</build_type></export></package>"


@pytest.mark.parametrize(("word", "certainty"), [("rclutils", Certainty.LIKELY), ("rcutils::rcutils", None)])
def test_how_sure_it_is(word, certainty, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text(
        f"project(p)\nfind_package(rcutils REQUIRED)\nament_target_dependencies(driver {word})\n"
    )
    (hit,) = found(package_view(tmp_path))
    assert hit.certainty is certainty
