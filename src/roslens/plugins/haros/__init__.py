"""Plug-ins written for HAROS (``haros_plugin_*`` packages with ``plugin.yaml``), run unmodified."""
