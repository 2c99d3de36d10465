"""The page that shows a running system in a browser, second by second."""
