"""What plug-ins said of packages, kept as soon as they said it: a command that is killed goes on from there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import msgspec

from roslens.plugins.outcome import Outcome

if TYPE_CHECKING:
    from roslens.source.measure.analyse_package import MeasuredPackage
    from roslens.store.cache import Cache

_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder(Outcome).decode


class KeptOutcomes:
    """Asks plug-ins about a package once for each set of inputs to their findings."""

    def __init__(self, cache: Cache, keys: Mapping[str, str]) -> None:
        """Keep in a cache.

        Args:
            cache: that later commands have, too.
            keys: of all that shapes the result of a package, by package.
        """
        self._cache = cache
        self._keys = keys

    def of(self, measured: MeasuredPackage, look: Callable[[MeasuredPackage], Outcome]) -> Outcome:
        """Return the outcome of plug-ins for a package; after a failure they are asked again the next time.

        Args:
            measured: the package.
            look: asks them.
        """
        key = f"said:{self._keys[measured.package]}"
        if known := self._cache.get([key]):
            return _decode(known[key])
        outcome = look(measured)
        # Plug-ins were given nothing of a package that could not be measured.
        if not measured.lost and not outcome.failures and outcome != Outcome():
            self._cache.put({key: _encode(outcome)})
        return outcome
