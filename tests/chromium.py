"""The browser that tests and pictures drive."""

import shutil
from pathlib import Path

CHROMIUM = Path(shutil.which("chromium-headless-shell") or shutil.which("chromium") or "/usr/bin/chromium")
"""The shell draws the same pages with half the processor time, as it has no window, extensions or desktop."""
