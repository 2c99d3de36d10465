"""The screen of ``roslens top``: alerts by first cause, the tree, and all that is known of what is chosen."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

import msgspec
from rich.text import Text
from textual.app import App, ComposeResult
from textual.binding import BindingType
from textual.containers import Vertical, VerticalScroll
from textual.coordinate import Coordinate
from textual.widgets import DataTable, Footer, Input, OptionList, Static
from textual.widgets.option_list import Option

from roslens.cli.top.feed import Feed
from roslens.cli.top.lines import Line, Look, alert_lines, columns, detail_lines, entities, head, lines
from roslens.cli.top.past import Past
from roslens.dashboard.live.detail import Detail
from roslens.dashboard.live.snapshot import Snapshot
from roslens.model.errors import RoslensError
from roslens.report.writing.terminal import Terminal

PACE_S = 1.0
_STATE_WIDTH, _SPARK_WIDTH, _CELL_WIDTH, _LEAST_NAME = 12, 8, 9, 26
_PADDING, _SCROLLBAR, _MARKS = 2, 2, 2
_HELP = """\
j k up down  next and previous row     enter  all that is known of the row
space        close or open a row       n      next alert, and its row
/            only names with this      esc    clear filter, close detail
w            only what is wrong        p      stop and go on
q            end"""


class Board(App[None]):
    """Polls a feed each second and shows its content."""

    ENABLE_COMMAND_PALETTE = False
    CSS = """
    #head { height: 1; background: $boost; }
    #alerts { height: auto; max-height: 7; border: none; border-bottom: solid $primary; display: none; padding: 0;
        text-wrap: nowrap; text-overflow: ellipsis; }
    #tree { height: 1fr; overflow-x: hidden; }
    #detail { height: auto; max-height: 45%; border-top: solid $primary; display: none; }
    #filter { display: none; height: 1; border: none; }
    #help { display: none; height: auto; border-top: solid $primary; }
    """
    BINDINGS: ClassVar[list[BindingType]] = [
        ("q", "quit", "End"),
        ("enter", "about", "Detail"),
        ("space", "fold", "Fold"),
        ("n", "next_alert", "Next alert"),
        ("w", "worse", "Only wrong"),
        ("slash", "find", "Filter"),
        ("p", "pause", "Pause"),
        ("escape", "clear", "Clear"),
        ("question_mark", "help", "Keys"),
    ]

    def __init__(self, feed: Feed, terminal: Callable[[int], Terminal], *, pace_s: float = PACE_S) -> None:
        """Show the content of ``feed``; ``terminal`` returns what can be shown in so many columns."""
        super().__init__()
        self._feed = feed
        self._terminal = terminal
        self._pace_s = pace_s
        self._past = Past()
        self._view = Look()
        self._snapshot: Snapshot | None = None
        self._lines: tuple[Line, ...] = ()
        self._headings: tuple[tuple[str, str], ...] | None = None
        self._alerted: tuple[str, ...] = ()
        self._about = ""
        self._opened = False
        self._alert = -1
        self._paused = False
        self._problem = ""

    def compose(self) -> ComposeResult:
        """Make the parts of the screen."""
        yield Static(id="head", markup=False)
        with Vertical():
            yield OptionList(id="alerts", markup=False)
            yield Input(id="filter", placeholder="only names with this in them")
            yield DataTable(id="tree", cursor_type="row", zebra_stripes=False)
            with VerticalScroll(id="detail"):
                yield Static(id="about", markup=False)
            yield Static(_HELP, id="help", markup=False)
        yield Footer()

    def on_mount(self) -> None:
        """Begin to ask."""
        self.query_one("#tree").focus()
        self._ask()
        self.set_interval(self._pace_s, self._ask)

    def _ask(self) -> None:
        if not self._paused:
            self.run_worker(self._asked, thread=True, exclusive=True, group="ask")

    def _asked(self) -> None:
        """Ask the feed, in a thread of its own: an answer may take a while."""
        about = self._about
        try:
            snapshot = self._feed.snapshot()
            detail = self._feed.detail(about) if about else None
        except RoslensError as error:
            self.call_from_thread(self._fail, str(error))
        else:
            self.call_from_thread(self._take, snapshot, detail)

    def _fail(self, problem: str) -> None:
        self._problem = problem
        self._show_head()

    def _take(self, snapshot: Snapshot | None, detail: Detail | None) -> None:
        self._problem = ""
        if snapshot is not None:
            self._snapshot = snapshot
            self._past.take(snapshot)
            self._show()
        self._show_head()
        if self._about:
            self._show_detail(detail)

    def _show_head(self) -> None:
        text = head(self._snapshot, self._feed.title, self._problem)
        if self._paused:
            text = f"PAUSED  {text}"
        found = self._shown_on()
        self.query_one("#head", Static).update(Text(found.clean(text), "bold red" if self._problem else "bold"))

    def _shown_on(self) -> Terminal:
        return self._terminal(self.size.width)

    def _show(self) -> None:
        snapshot = self._snapshot
        if snapshot is None:
            return
        terminal = self._shown_on()
        self._show_alerts(snapshot, terminal)
        longest = max((2 * row.depth + len(row.name) + _MARKS for row in snapshot.rows), default=0)
        least = max(_LEAST_NAME, min(longest, self._room // 2))
        headings = columns(snapshot, (self._room - least) // (_CELL_WIDTH + _PADDING))
        found = lines(snapshot, self._view, self._past, headings, terminal=terminal)
        table = self.query_one("#tree", DataTable)
        if headings != self._headings or [one.key for one in found] != [one.key for one in self._lines]:
            self._rebuild(table, headings, found)
        else:
            for place, (one, before) in enumerate(zip(found, self._lines, strict=True)):
                for column, cell in enumerate(_cells(one)):
                    if one.cells[column] != before.cells[column] or one.style != before.style:
                        table.update_cell_at(Coordinate(place, column), cell)
        self._headings, self._lines = headings, found

    def _rebuild(self, table: DataTable[Text], headings: tuple[tuple[str, str], ...], found: tuple[Line, ...]) -> None:
        """Fill the table anew; the cursor stays on its row."""
        chosen = self._chosen()
        name = max(self._room - (_CELL_WIDTH + _PADDING) * len(headings), 1)
        table.clear(columns=True)
        table.add_column("state", width=_STATE_WIDTH)
        table.add_column("", width=name)
        for _, heading in headings:
            table.add_column(heading.lower(), width=_CELL_WIDTH)
        table.add_column("2 min", width=_SPARK_WIDTH)
        for one in found:
            table.add_row(*_cells(one), key=one.key)
        place = next((at for at, one in enumerate(found) if chosen and one.key == chosen.key), 0)
        table.move_cursor(row=place, animate=False)

    @property
    def _room(self) -> int:
        """Columns for names and values: what states, sparklines, padding and the scroll bar leave."""
        return self.size.width - _STATE_WIDTH - _SPARK_WIDTH - 3 * _PADDING - _SCROLLBAR

    def _show_alerts(self, snapshot: Snapshot, terminal: Terminal) -> None:
        found = alert_lines(snapshot.alerts, terminal)
        box = self.query_one("#alerts", OptionList)
        box.display = bool(found)
        if tuple(text for _, text, _ in found) == self._alerted:
            return
        self._alerted = tuple(text for _, text, _ in found)
        marked = box.highlighted
        box.clear_options()
        box.add_options([Option(Text(text, style, no_wrap=True, overflow="ellipsis")) for _, text, style in found])
        if marked is not None and found:
            box.highlighted = min(marked, len(found) - 1)

    def _show_detail(self, detail: Detail | None) -> None:
        terminal = self._shown_on()
        text = detail_lines(detail, self._past, terminal) if detail else (f"{self._about} is not there any more",)
        self.query_one("#about", Static).update(Text("\n".join(text)))
        if self._opened:
            # The detail takes room away from the table, and the row must not go with it.
            self._opened = False
            self.call_after_refresh(self._show_row)

    def _show_row(self) -> None:
        table = self.query_one("#tree", DataTable)
        table.move_cursor(row=table.cursor_row, animate=False, scroll=True)

    def _chosen(self) -> Line | None:
        place = self.query_one("#tree", DataTable).cursor_row
        return self._lines[place] if 0 <= place < len(self._lines) else None

    def _open(self, entity: str) -> None:
        self._about = entity
        self._opened = bool(entity)
        self.query_one("#detail").display = bool(entity)
        if entity:
            self.query_one("#about", Static).update("…")
            self._ask_once()

    def _ask_once(self) -> None:
        self.run_worker(self._asked, thread=True, exclusive=True, group="ask")

    def _go_to(self, entity: str) -> None:
        """Move to the row of an entity; open what is closed above it."""
        if self._snapshot is not None and entity not in entities(self._lines):
            self._view = Look()
            self._show()
        place = entities(self._lines).get(entity)
        if place is not None:
            self.query_one("#tree", DataTable).move_cursor(row=place, animate=False)
        self._open(entity)

    def on_data_table_row_selected(self) -> None:
        """Show all that is known of the row."""
        self.action_about()

    def on_option_list_option_selected(self, event: OptionList.OptionSelected) -> None:
        """Go to what an alert is about."""
        self._alert = event.option_index
        self._to_alert()

    def _to_alert(self) -> None:
        if self._snapshot is None:
            return
        found = alert_lines(self._snapshot.alerts, self._shown_on())
        if found:
            self._alert %= len(found)
            self.query_one("#alerts", OptionList).highlighted = self._alert
            self._go_to(found[self._alert][0])

    def on_input_changed(self, event: Input.Changed) -> None:
        """Show only names that have the text in them."""
        self._look(filter=event.value.lower())

    def on_input_submitted(self) -> None:
        """Go back to the tree."""
        self.query_one("#tree").focus()

    def on_resize(self) -> None:
        """Lay the table out anew."""
        self._headings = None
        self._show()

    def _look(self, **values: object) -> None:
        self._view = msgspec.structs.replace(self._view, **values)
        self._show()

    def action_about(self) -> None:
        """Open or close all that is known of the row."""
        chosen = self._chosen()
        self._open("" if chosen is None or chosen.entity == self._about else chosen.entity)

    def action_fold(self) -> None:
        """Close or open the row."""
        chosen = self._chosen()
        if chosen is not None and chosen.parts:
            self._look(closed=self._view.closed ^ {chosen.key})

    def action_next_alert(self) -> None:
        """Go to the next alert."""
        self._alert += 1
        self._to_alert()

    def action_worse(self) -> None:
        """Show only what is wrong, or everything again."""
        self._look(worse=not self._view.worse)

    def action_find(self) -> None:
        """Ask for a filter."""
        box = self.query_one("#filter", Input)
        box.display = True
        box.focus()

    def action_clear(self) -> None:
        """Clear the filter, and close the detail."""
        box = self.query_one("#filter", Input)
        box.value = ""
        box.display = False
        self._look(filter="", worse=False)
        self._open("")
        self.query_one("#help").display = False
        self.query_one("#tree").focus()

    def action_pause(self) -> None:
        """Stop to ask, or go on."""
        self._paused = not self._paused
        self._show_head()

    def action_help(self) -> None:
        """Show the keys, or hide them."""
        box = self.query_one("#help")
        box.display = not box.display

    def key_j(self) -> None:
        """Go to the next row."""
        self.query_one("#tree", DataTable).action_cursor_down()

    def key_k(self) -> None:
        """Go to the previous row."""
        self.query_one("#tree", DataTable).action_cursor_up()


def _cells(line: Line) -> tuple[Text, ...]:
    state, name, *values, spark = line.cells
    style = "" if line.style == "dim" else line.style
    return (
        Text(state, line.style), Text(name, style if line.style == "red" else "", no_wrap=True, overflow="ellipsis"),
        *(Text(value, justify="right") for value in values), Text(spark, "cyan"),
    )  # fmt: skip
