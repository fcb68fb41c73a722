"""Where the project is, and what is tested."""

import os

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
SCRIPT = os.path.join(TOP, "Blend", "Export.py")
RAYTRACER = os.environ.get("RAYTRACER", os.path.join(TOP, "raytracer"))
