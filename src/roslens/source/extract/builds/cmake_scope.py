"""Variables of CMake by scope; what a branch sets that may not be taken is merged with what was there before."""

from __future__ import annotations

from collections.abc import Callable

Layer = dict[str, str | None]


class Scope:
    """Variables of a folder or function. A value None is of a variable that is known not to be set."""

    def __init__(
        self, parent: Scope | None = None, first: dict[str, str | None] | None = None, *, block: bool = False
    ) -> None:
        """Open a scope in which the variables of ``parent`` can be read; ``block`` is whether it is one of block()."""
        self.parent = parent
        self.block = block
        self.layers: list[Layer] = [dict(first or {})]

    def get(self, name: str) -> tuple[bool, str | None]:
        """Return whether anything is known of a variable, and its value."""
        scope: Scope | None = self
        while scope is not None:
            for layer in reversed(scope.layers):
                if name in layer:
                    return True, layer[name]
            scope = scope.parent
        return False, None

    def set(self, name: str, value: str | None) -> None:
        """Set a variable, or unset it with None."""
        self.layers[-1][name] = value

    def enter(self) -> None:
        """Begin a branch that may not be taken."""
        self.layers.append({})

    def leave(self) -> Layer:
        """End it; what it set is no longer set."""
        return self.layers.pop()

    def merge(
        self,
        branches: list[Layer],
        usual: int | None,
        either: Callable[[str, list[str | None]], str | None],
    ) -> None:
        """Set what branches have set of which one was taken.

        Args:
            branches: what each has set; one that sets nothing stands for none being taken.
            usual: the one that is taken where nobody decides otherwise; None where that is unknown.
            either: makes one value of those that a variable may have.
        """
        for name in sorted({name for branch in branches for name in branch}):
            _, before = self.get(name)
            values = [branch.get(name, before) for branch in branches]
            if usual is not None:
                self.set(name, values[usual])
            elif all(value == values[0] for value in values):
                self.set(name, values[0])
            else:
                self.set(name, either(name, values))
