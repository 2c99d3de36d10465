"""A language server on pygls: findings of a file when it is opened and saved, what they mean, how to silence one."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from lsprotocol import types
from pygls.lsp.server import LanguageServer
from pygls.uris import to_fs_path

from roslens import __version__
from roslens.cli.editor.editor_findings import Shown, failure_as_finding, hover_text, ignore_edits, shown
from roslens.cli.editor.editor_fixes import EditorFix
from roslens.cli.editor.read_folder import Folder
from roslens.model.edit import Edit
from roslens.model.errors import RoslensError
from roslens.source.engines.watched_reader import LostReaderError

FIX_ALL = "source.fixAll.roslens"
"""Kind of the action that makes all fixes of a document; editors may run it whenever they save."""


class Server:
    """What the editor's messages lead to; :attr:`protocol` is pygls' server."""

    def __init__(self, options: Any) -> None:
        """``options`` are those of ``roslens lsp``."""
        self._options = options
        self._folders: list[Folder] | None = None
        self._shown: dict[str, tuple[Shown, ...]] = {}
        self._found_in: dict[str, Folder] = {}
        self.protocol = LanguageServer("roslens", __version__)
        self._take(types.TEXT_DOCUMENT_DID_OPEN, self._opened)
        self._take(types.TEXT_DOCUMENT_DID_SAVE, self._saved)
        self._take(types.TEXT_DOCUMENT_DID_CLOSE, self._closed)
        self._take(types.TEXT_DOCUMENT_HOVER, self._hover)
        kinds = types.CodeActionOptions(code_action_kinds=[types.CodeActionKind.QuickFix, FIX_ALL])
        self._take(types.TEXT_DOCUMENT_CODE_ACTION, self._actions, kinds)

    def _take(self, method: str, answer: Callable[[Any], Any], options: Any = None) -> None:
        # pygls marks what it calls, which a method does not let it do.
        def handler(params: Any) -> Any:
            return answer(params)

        self.protocol.feature(method, options)(handler)

    def _opened(self, params: types.DidOpenTextDocumentParams) -> None:
        self._publish(params.text_document.uri)

    def _saved(self, params: types.DidSaveTextDocumentParams) -> None:
        self._publish(params.text_document.uri, again=True)

    def _closed(self, params: types.DidCloseTextDocumentParams) -> None:
        self._shown.pop(params.text_document.uri, None)
        self._found_in.pop(params.text_document.uri, None)

    def _publish(self, uri: str, *, again: bool = False) -> None:
        name = to_fs_path(uri)
        for folder in self._opened_folders() if name else ():
            path = folder.path_of(Path(str(name)))
            if not path:
                continue
            found = folder.look(path, again=again)
            if isinstance(found, str):
                self._tell(found)
            elif found is not None:
                self._found_in[uri] = folder
                lines = self.protocol.workspace.get_text_document(uri).lines
                findings = (*found.findings, *map(failure_as_finding, found.failures))
                self._show(uri, shown(findings, lines))
                return
        self._show(uri, ())

    def _show(self, uri: str, found: tuple[Shown, ...]) -> None:
        self._shown[uri] = found
        self.protocol.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(uri=uri, diagnostics=[_diagnostic(one) for one in found])
        )

    def _opened_folders(self) -> list[Folder]:
        if self._folders is None:
            self._folders = []
            folders = [one.uri for one in (self.protocol.workspace.folders or {}).values()]
            for uri in folders or [self.protocol.workspace.root_uri]:
                name = to_fs_path(uri) if uri else None
                if name is None:
                    continue
                try:
                    self._folders.append(Folder(Path(name), self._options))
                except (RoslensError, LostReaderError) as error:
                    self._tell(str(error))
        return self._folders

    def _tell(self, text: str) -> None:
        print(f"roslens: {text}", file=sys.stderr)
        self.protocol.window_show_message(
            types.ShowMessageParams(type=types.MessageType.Warning, message=f"roslens: {text}")
        )

    def _hover(self, params: types.HoverParams) -> types.Hover | None:
        line = params.position.line
        there = [one for one in self._shown.get(params.text_document.uri, ()) if one.span.line == line]
        if not there:
            return None
        rules = {key: rule for folder in self._folders or () for key, rule in folder.rules.items()}
        text = hover_text([one.finding for one in there], rules)
        return types.Hover(types.MarkupContent(types.MarkupKind.Markdown, text))

    def _actions(self, params: types.CodeActionParams) -> list[types.CodeAction]:
        only = [str(one) for one in params.context.only or ()]
        found: list[types.CodeAction] = []
        if _is_wanted(types.CodeActionKind.QuickFix, only):
            found += [*self._fixes(params), *self._silencing(params)]
        if _is_wanted(FIX_ALL, only) and (action := self._fix_all(params.text_document.uri)) is not None:
            found.append(action)
        return found

    def _fixes(self, params: types.CodeActionParams) -> Iterator[types.CodeAction]:
        uri = params.text_document.uri
        wanted = range(params.range.start.line, params.range.end.line + 1)
        there = [one for one in self._shown.get(uri, ()) if one.finding.edits and one.span.line in wanted]
        if not there or (known := self._fixable(uri)) is None:
            return
        folder, document = known
        path = there[0].finding.path
        for one, fix in zip(there, folder.fixes([one.finding for one in there], path, document), strict=False):
            if fix is not None:
                yield types.CodeAction(
                    fix.title,
                    kind=types.CodeActionKind.QuickFix,
                    diagnostics=[_diagnostic(one)],
                    is_preferred=True,
                    edit=_workspace_edit(fix, folder, one.finding.path, uri),
                )

    def _fix_all(self, uri: str) -> types.CodeAction | None:
        findings = [one.finding for one in self._shown.get(uri, ()) if one.finding.edits]
        if not findings or (known := self._fixable(uri)) is None:
            return None
        folder, document = known
        path = findings[0].path
        fix = folder.fix_of_all(findings, path, document)
        if fix is None:
            return None
        return types.CodeAction(fix.title, kind=FIX_ALL, edit=_workspace_edit(fix, folder, path, uri))

    def _fixable(self, uri: str) -> tuple[Folder, bytes] | None:
        """Return the folder that a document was found in, and the document as the editor has it."""
        folder = self._found_in.get(uri)
        if folder is None:
            return None
        return folder, self.protocol.workspace.get_text_document(uri).source.encode("utf-8", "surrogatepass")

    def _silencing(self, params: types.CodeActionParams) -> list[types.CodeAction]:
        uri = params.text_document.uri
        lines = self.protocol.workspace.get_text_document(uri).lines
        wanted = range(params.range.start.line, params.range.end.line + 1)
        found = []
        for one in self._shown.get(uri, ()):
            for edit in ignore_edits(one.finding, one.finding.path, lines) if one.span.line in wanted else ():
                place = types.Position(edit.line, edit.column)
                insert = types.TextEdit(types.Range(place, place), edit.text)
                found.append(
                    types.CodeAction(
                        edit.title,
                        kind=types.CodeActionKind.QuickFix,
                        diagnostics=[_diagnostic(one)],
                        edit=types.WorkspaceEdit(changes={uri: [insert]}),
                    )
                )
        return found


def _is_wanted(kind: str, only: Sequence[str]) -> bool:
    """Return whether a client that asks for some kinds of actions alone asks for one of this kind."""
    return not only or any(kind == one or kind.startswith(f"{one}.") for one in only)


def _workspace_edit(fix: EditorFix, folder: Folder, path: str, uri: str) -> types.WorkspaceEdit:
    """Return the changes; the document itself goes by the name that the editor gave it."""
    return types.WorkspaceEdit(
        changes={
            uri if target == path else (folder.root / target).as_uri(): [
                types.TextEdit(_range(one), one.text) for one in edits
            ]
            for target, edits in fix.edits.items()
        }
    )


def _range(edit: Edit) -> types.Range:
    start, end = types.Position(edit.line - 1, edit.column - 1), types.Position(edit.end_line - 1, edit.end_column - 1)
    return types.Range(start, end)


def _diagnostic(one: Shown) -> types.Diagnostic:
    start, end = types.Position(one.span.line, one.span.start), types.Position(one.span.line, one.span.end)
    return types.Diagnostic(
        types.Range(start, end),
        one.finding.message,
        severity=types.DiagnosticSeverity(one.severity),
        code=one.finding.rule,
        source="roslens",
    )
