"""What commands of CMake make, while it is put together: targets, components, what is installed."""

from __future__ import annotations

import msgspec

from roslens.source.extract.facts.node_facts import Evidence


class Item(msgspec.Struct, frozen=True):
    """A source, library or file as given, with the folder it is relative to."""

    text: str
    folder: str
    evidence: Evidence
    conditions: tuple[str, ...] = ()


class Made(msgspec.Struct):
    """A target while it is put together.

    Attributes:
        name: of the target.
        executable: or else a library.
        evidence: where it is made.
        conditions: under which.
        test: whether it is made by a command for tests.
        form: of a library: ``STATIC``, ``SHARED``, ``MODULE``, ``OBJECT``, ``INTERFACE`` or empty.
        sources: as given.
        given: sources that it gives to those that link it.
        links: libraries as given.
        output: name of its file where that differs.
        renamed: whether that was said of this kind of file alone.
        installed: where it is installed to.
    """

    name: str
    executable: bool
    evidence: Evidence
    conditions: tuple[str, ...]
    test: bool = False
    form: str = ""
    sources: list[Item] = []
    given: list[Item] = []
    links: list[Item] = []
    output: str = ""
    renamed: bool = False
    installed: list[str] = []

    @property
    def output_property(self) -> str:
        """The property that names the file of targets of its kind."""
        if self.executable:
            return "RUNTIME_OUTPUT_NAME"
        # Where the form is left open, ROS builds what is shared.
        return "ARCHIVE_OUTPUT_NAME" if self.form == "STATIC" else "LIBRARY_OUTPUT_NAME"


class Component(msgspec.Struct, frozen=True):
    """A component that is registered: its class, library and the program that holds it alone."""

    name: str
    library: str
    executable: str
    evidence: Evidence
    conditions: tuple[str, ...]


class Installed(msgspec.Struct, frozen=True):
    """Files that are installed: ``kind`` is ``programs``, ``files`` or ``directory``; ``only`` are patterns."""

    kind: str
    item: Item
    destination: str
    rename: str = ""
    only: tuple[str, ...] = ()
