"""The seam: what a plug-in declares, how it is found, loaded, ordered, isolated and checked."""
