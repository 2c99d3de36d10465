"""Parameter files of ROS 2 in a package, read as rcl reads them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.errors import DocumentError
from roslens.model.source import Language, Role
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.parameters.parameter_file import ros2_parameters
from roslens.source.rules.package_view import PackageView


def parameter_files(view: PackageView, word: re.Pattern[bytes] | bytes) -> Iterator[tuple[str, list[Setting]]]:
    """Yield the path and the settings of each file of a package's own that can be read.

    Args:
        view: the package.
        word: a file without it is not read.
    """
    pattern = re.compile(re.escape(word)) if isinstance(word, bytes) else word
    for file in view.of_language(Language.YAML, roles=(Role.OWN,)):
        content = view.read(file.path)
        if b"ros__parameters" not in content or pattern.search(content) is None:
            continue
        try:
            settings = ros2_parameters(content, file.path)
        except DocumentError:
            continue  # Why it cannot be read is a finding of the launch file that gives it to a node.
        yield file.path, settings
