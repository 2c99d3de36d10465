"""Small nodes in C++ that are evaluated and run: what evaluation says is held against what the program makes."""
