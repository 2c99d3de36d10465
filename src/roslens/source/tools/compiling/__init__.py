"""How files are compiled, read from what a build left. Start with ``compile_commands``."""
