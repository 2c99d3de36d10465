"""A heat map of rank correlations: strength by area and ink, its direction by a sign, never by colour alone."""

from __future__ import annotations

import msgspec

from roslens.model.study import Study


class Tile(msgspec.Struct, frozen=True):
    """A pair: 0 to 4 for its strength, its sign, whether it may be chance, and its tooltip."""

    row: int
    column: int
    strength: int
    positive: bool
    doubtful: bool
    text: str
    label: str


class HeatMap(msgspec.Struct, frozen=True):
    """The names of rows and columns, and the tiles below the diagonal."""

    titles: tuple[str, ...]
    tiles: tuple[Tile, ...]


def heat_map(study: Study) -> HeatMap:
    """Return the map of all quantities that go into a correlation, in the order of columns."""
    used = {key for one in study.correlations for key in (one.one, one.other)}
    columns = [column for column in study.corpus.columns if column.key in used]
    place = {column.key: number for number, column in enumerate(columns)}
    tiles: list[Tile] = []
    for one in study.correlations:
        value = one.spearman.value
        titles = (study.column(one.one).title, study.column(one.other).title)
        doubtful = one.spearman.adjusted >= 0.05
        label = f"{titles[0]} and {titles[1]}: {value:.2f} ({one.spearman.low:.2f} to {one.spearman.high:.2f})"
        label += ", may be chance" if doubtful else ""
        # What rounds to nothing has no direction.
        written = (f"{value:+.1f}" if abs(value) >= 0.05 else "0").replace("0.", ".")
        row, column = sorted((place[one.one], place[one.other]), reverse=True)
        tiles.append(Tile(row, column, min(4, int(abs(value) * 5)), value >= 0, doubtful, written, label))
    return HeatMap(tuple(column.title for column in columns), tuple(tiles))
