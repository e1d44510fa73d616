"""Kinds of rays, in the order of the scene files, and which question is asked with them."""

RAY_KINDS = {"random": "closest", "camera": "closest", "shadow": "any", "diffuse": "closest"}
