"""The plug-in of rqt: a board, and who asks the monitor for it."""

from python_qt_binding.QtCore import QObject, Signal
from rqt_gui_py.plugin import Plugin

from rqt_roslens.board import Board
from rqt_roslens.monitor import Watcher

ADDRESS = "127.0.0.1:8080"


class _Bridge(QObject):
    """Carries what comes in the thread that asks to the one that shows."""

    came = Signal(object, object, str)


class RoslensPlugin(Plugin):
    """Shows how a running robot stands to what is expected of it."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RoslensPlugin")
        given = [one for one in context.argv() if not one.startswith("-")]
        self._given = given[0] if given else ""
        self.board = Board(self._given or ADDRESS)
        if context.serial_number() > 1:
            self.board.setWindowTitle(f"Roslens ({context.serial_number()})")
        self._bridge = _Bridge()
        self._bridge.came.connect(self.board.show_look)
        self._watcher = Watcher(self._bridge.came.emit)
        self.board.chosen.connect(self._watcher.choose)
        self.board.asked.connect(self._watcher.watch)
        context.add_widget(self.board)
        self._watcher.watch(self.board.address.text())
        self._watcher.start()

    def shutdown_plugin(self):
        """Stop to ask."""
        self._bridge.came.disconnect()
        self._watcher.close()

    def save_settings(self, plugin_settings, instance_settings):
        """Keep the address without its token, which belongs to this session only."""
        instance_settings.set_value("address", self.board.address.text().partition("?")[0])

    def restore_settings(self, plugin_settings, instance_settings):
        """Ask the monitor that was asked last, where none was given."""
        kept = instance_settings.value("address")
        if kept and not self._given:
            self.board.address.setText(kept)
            self._watcher.watch(kept)
