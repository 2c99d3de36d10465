"""Revisions of clones as folders, without what is no text; large files that a clone does not have are left out."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

_LEFT_OUT = (
    ".dae", ".stl", ".obj", ".png", ".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".pgm", ".ico", ".pcd", ".bag", ".pdf",
    ".npz", ".apk", ".jar", ".java", ".class", ".so", ".a", ".zip", ".gz", ".weights", ".h5", ".mp4",
)  # fmt: skip
_LINK = b"120000"
# A clone may be partial; nothing is fetched by a test.
_ENVIRONMENT = {**os.environ, "GIT_NO_LAZY_FETCH": "1"}


def check_out(clone: Path, commit: str, target: Path) -> None:
    """Write the files of a commit below ``target``, and the links between them.

    Raises:
        CalledProcessError: the clone has no such commit.
    """
    tree = subprocess.run(
        ["git", "-C", str(clone), "ls-tree", "-rz", commit], check=True, capture_output=True, env=_ENVIRONMENT
    )
    wanted = []
    for row in filter(None, tree.stdout.split(b"\0")):
        about, _, path = row.partition(b"\t")
        mode, kind, blob = about.split()
        if kind == b"blob" and not path.decode().lower().endswith(_LEFT_OUT):
            wanted.append((blob, path.decode(), mode == _LINK))
    with subprocess.Popen(
        ["git", "-C", str(clone), "cat-file", "--batch"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=_ENVIRONMENT,
    ) as reading:  # fmt: skip
        assert reading.stdin is not None
        assert reading.stdout is not None
        for blob, name, is_link in wanted:
            reading.stdin.write(blob + b"\n")
            reading.stdin.flush()
            head = reading.stdout.readline().split()
            if head[1] == b"missing":
                continue
            content = reading.stdout.read(int(head[2]))
            reading.stdout.read(1)
            file = target / name
            file.parent.mkdir(parents=True, exist_ok=True)
            if not is_link:
                file.write_bytes(content)
            elif content and (file.parent / os.fsdecode(content)).resolve().is_relative_to(target.resolve()):
                file.symlink_to(os.fsdecode(content))
