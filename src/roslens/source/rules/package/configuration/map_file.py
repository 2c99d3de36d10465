"""Rule ``package.map_file``: the description of a map that a map server refuses."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from posixpath import basename, dirname, join, normpath

from roslens.judge.documents.yaml_tree import Items, Node, Scalar, Table, read_tree
from roslens.model.errors import DocumentError
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ID = "package.map_file"
_MODES = ("trinary", "scale", "raw")
_PICTURES = (".pgm", ".png", ".bmp", ".jpg", ".jpeg", ".tif", ".tiff", ".gif")

_Told = tuple[str, Node, Certainty | None]


def found(view: PackageView) -> Iterator[Hit]:
    """Yield what is wrong in each description of a map: its image, its origin, its thresholds and its mode."""
    for file in view.of_language(Language.YAML, roles=(Role.OWN,)):
        content = view.read(file.path)
        if b"image" not in content or b"resolution" not in content or b"free_thresh" not in content:
            continue
        try:
            tree = read_tree(content, file.path, last_counts=True)
        except DocumentError:
            continue
        match tree.root:
            case Table(nodes=nodes) if "image" in nodes and "resolution" in nodes and "ros__parameters" not in nodes:
                for message, node, certainty in (*_image(nodes["image"], file.path, view), *_values(nodes)):
                    line = tree.location(node.place).line
                    yield Hit(_ID, message, line, context=message, path=file.path, certainty=certainty)


def _image(node: Node, path: str, view: PackageView) -> Iterator[_Told]:
    match node:
        case Scalar(text=text) if text and "$" not in text:
            pass
        case _:
            return
    if text.startswith("/"):
        return
    folder = dirname(path)
    whole = normpath(join(folder, text))
    if whole.startswith("..") or view.exists(whole):
        return
    beside = [basename(one) for one in view.listing if dirname(view.path(one)) == folder and one.endswith(_PICTURES)]
    near = basename(text) if basename(text) in beside else next(iter(get_close_matches(text, beside, 1)), "")
    expected = f"{near!r}, which lies beside it" if near else "a file of this package"
    home = ": a path that does not begin with a slash starts in the folder of this file" if text[0] == "~" else ""
    # Without an image beside it, it may be made or fetched by somebody.
    certainty = None if near or home else Certainty.HEURISTIC
    yield f"the image of this map is {text!r}, which is not there{home}; expected {expected}", node, certainty


def _values(nodes: dict[str, Node]) -> Iterator[_Told]:
    match nodes.get("origin"):
        case Items(nodes=items) as node if len(items) != 3:
            yield f"origin has {len(items)} entries; expected [x, y, yaw]", node, None
        case Scalar() as node:
            yield f"origin is {node.text!r}; expected [x, y, yaw]", node, None
    for key in ("occupied_thresh", "free_thresh"):
        match nodes.get(key):
            case Scalar(text=text) as node if (value := _number(text)) is not None and not 0 <= value <= 1:
                yield f"{key} is {text}; expected a share between 0 and 1", node, None
    match nodes.get("mode"):
        case Scalar(text=text) as node if text not in _MODES:
            yield f"mode is {text!r}; expected one of {', '.join(_MODES)}", node, None


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


RULE = PackageRule(
    id=_ID,
    title="Map that the map server refuses",
    finds="The description of a map (`image`, `resolution`, `origin` …) whose image is not there, also one that begins "
    "with `~`, which is no home here; an `origin` that is not three numbers; a threshold that is no share; a `mode` "
    "that does not exist. An absolute path is another rule's; an image that may be made later is a note.",
    why="The map server cannot load the map: its configuration fails, and nothing that needs the map starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("configuration", "navigation"),
    bad="image: ~/field.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nfree_thresh: 0.2",
    good="image: field.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nfree_thresh: 0.2",
    found=found,
)
