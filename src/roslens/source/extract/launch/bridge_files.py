"""Bridges to Gazebo that a file names: parameter ``config_file`` of ros_gz_bridge (``src/bridge_config.cpp``).

What an entry of the file bridges is what a word on the command line of the bridge says, so it is given as one.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.symbolic.text import Text

_PACKAGE = "ros_gz_bridge"
_PARAMETER = "config_file"
_WAYS = {"BIDIRECTIONAL": "@", "GZ_TO_ROS": "[", "ROS_TO_GZ": "]"}


def with_bridges(launched: Launched, files: Files) -> Launched:
    """Return what is started with the bridges of its file behind the words of its command line."""
    if launched.package.known != _PACKAGE:
        return launched
    # Of several that set it the last one holds.
    paths = [one.value.known for one in launched.settings if one.name.known == _PARAMETER]
    content = files.content(joined("", paths[-1])) if paths and paths[-1] else None
    if content is None:
        return launched
    return msgspec.structs.replace(launched, arguments=(*launched.arguments, *_words(content)))


def _words(content: bytes) -> Iterator[Text]:
    try:
        entries = load_yaml(content)
    except (UnsafeYamlError, RecursionError):
        return
    for one in entries if type(entries) is list else ():
        match one:
            case {"ros_type_name": str(kind), "gz_type_name": str(other)}:
                name = one.get("topic_name") or one.get("ros_topic_name") or one.get("gz_topic_name")
                way = _WAYS.get(str(one.get("direction", "BIDIRECTIONAL")))
                if name and way:
                    yield Text.of(f"{name}@{kind}{way}{other}")
